import { canBePaper, findMachine, isEmptyBox, isOnFilesPage, onFilesPage } from "../../src/internal.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { formatNumber, formatSize } from "../ui/format.js";
import { drawnSizeText as words } from "./text.js";
import type { Planned } from "../worker/protocol.js";

/** The drawing's size on the paper, and a button for the size in its file. */
export const DrawnSize = () => {
  const planned = usePageState((state) => state.planned);
  const unit = usePageState((state) => state.view.lengthUnit);
  if (!planned || isEmptyBox(planned.drawnBox)) return null;
  const { x0, y0, x1, y1 } = planned.drawnBox;
  return (
    <div className="drawn-size">
      <span>{words.drawn(formatSize(x1 - x0, y1 - y0, unit), scaleInWords(planned))}</span>
      <UseFilesPage planned={planned} />
    </div>
  );
};

/** In percent of the size in the file; two numbers if it is stretched. */
const scaleInWords = ({ pageToPaper: { a, b, c, d } }: Planned): string => {
  const percents = [Math.hypot(a, b), Math.hypot(c, d)].map((factor) =>
    formatNumber(100 * factor, factor < 0.1 ? 1 : 0),
  );
  return [...new Set(percents)].join(" × ");
};

const UseFilesPage = ({ planned }: { planned: Planned }) => {
  const store = usePageStore();
  const { changeSettings } = useActions();
  const page = { widthMm: planned.pageWidthMm, heightMm: planned.pageHeightMm };
  const isOnIt = usePageState((state) => isOnFilesPage(state.settings.prepare, page));
  if (isOnIt || !canBePaper(page)) return null;
  return (
    <Button
      kind="link"
      onClick={() => {
        store.setState({ typedPaper: null });
        changeSettings("file's page", (settings) => ({
          ...settings,
          prepare: onFilesPage(settings.prepare, page, findMachine(settings)),
        }));
      }}
    >
      {words.useFilesPage}
    </Button>
  );
};
