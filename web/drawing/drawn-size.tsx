import {
  canBePaper,
  findMachine,
  isEmptyBox,
  isOnFilesPage,
  onFilesPage,
  type PaperSize,
} from "../../src/internal.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { formatCount, formatNumber, formatSize } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { drawnSizeText as words, fillChoiceText, reportText } from "./text.js";
import type { Planned } from "../worker/protocol.js";

/** Over the sheet: the drawing's name, its size on the paper, and whether something of it is not drawn. */
export const DrawnSize = () => {
  const name = usePageState((state) => state.drawing?.name ?? null);
  const planned = usePageState((state) => state.planned);
  if (name === null) return null;
  return (
    <div className="drawn-size">
      <strong title={name}>{name}</strong>
      {/* First, because a phone shows only the beginning of the row. */}
      {planned && <Warnings planned={planned} />}
      {planned && !isEmptyBox(planned.drawnBox) && <Size planned={planned} />}
    </div>
  );
};

const Size = ({ planned }: { planned: Planned }) => {
  const unit = usePageState((state) => state.view.lengthUnit);
  const { widthMm, heightMm, turnedDeg } = planned.size;
  return (
    <>
      <span>
        {words.drawn(formatSize(widthMm, heightMm, unit), scaleInWords(planned.size))}
        {turnedDeg !== 0 && words.turned(turnedDeg)}
      </span>
      <UseFilesPage planned={planned} />
    </>
  );
};

/** The panel of the drawing lists them, and has choices for filled shapes. */
const Warnings = ({
  planned: { fileWarnings, layoutWarnings, fillCount, settings },
}: {
  planned: Planned;
}) => {
  const { showPanel } = useActions();
  const { hatch, hideCovered, outlineFills } = settings.prepare;
  const areOutlines = fillCount > 0 && outlineFills && hatch.spacingMm === 0 && !hideCovered;
  const hasWarnings = fileWarnings.length + layoutWarnings.length > 0;
  return (
    <>
      {hasWarnings && (
        <Button kind="link" className="drawn-warnings" onClick={() => showPanel("drawing")}>
          <Icon name="warning" />
          {reportText.title}
        </Button>
      )}
      {areOutlines && (
        <Button kind="link" onClick={() => showPanel("drawing")}>
          {fillChoiceText.become(fillCount, formatCount(fillCount))}
        </Button>
      )}
    </>
  );
};

/** In percent of the size in the file; two numbers if it is stretched. */
const scaleInWords = ({ scaleX, scaleY }: Planned["size"]): string => {
  const percents = [scaleX, scaleY].map((factor) => formatNumber(100 * factor, factor < 0.1 ? 1 : 0));
  return [...new Set(percents)].join(" × ");
};

/** A change that makes the paper the file's page, at true size, perhaps together with other settings. */
export const useFilesPage = () => {
  const store = usePageStore();
  const { changeSettings } = useActions();
  return (page: PaperSize, part: Partial<Planned["settings"]["prepare"]> = {}): void => {
    store.setState({ typedPaper: null });
    changeSettings("file's page", (settings) => ({
      ...settings,
      prepare: onFilesPage({ ...settings.prepare, ...part }, page, findMachine(settings)),
    }));
  };
};

const UseFilesPage = ({ planned }: { planned: Planned }) => {
  const takePage = useFilesPage();
  const page = { widthMm: planned.pageWidthMm, heightMm: planned.pageHeightMm };
  const isOnIt = usePageState((state) => isOnFilesPage(state.settings.prepare, page));
  // A sheet with several drawings has the size of the paper that they were laid out on.
  const isSheet = usePageState(({ drawing }) => Boolean(drawing?.sheet));
  if (isOnIt || isSheet || !canBePaper(page)) return null;
  return (
    <Button kind="link" onClick={() => takePage(page)}>
      {words.useFilesPage}
    </Button>
  );
};
