import {
  findMachine,
  isReached,
  orientedPaper,
  quarterTurned,
  quarterTurnedBox,
} from "../../src/internal.js";
import { paperBoxOf } from "../preview/frame.js";
import type { Planned } from "../worker/protocol.js";
import { useActions, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { formatCount, formatSize } from "../ui/format.js";
import { reachText as words } from "./text.js";

/** The height of what is turned: the paper, or at true size the file's page. */
const turningHeightMm = ({ settings, choice, pageToPaper, pageWidthMm, pageHeightMm }: Planned): number => {
  const { paper, landscape } = settings.prepare;
  if (choice.how !== "corner") return orientedPaper(paper, landscape).heightMm;
  const page = paperBoxOf([0, 0, pageWidthMm, pageHeightMm], pageToPaper);
  return page.yMm + page.heightMm;
};

/** Why the drawing can't be plotted, and a button that turns it if that helps. */
export const OutOfReach = () => {
  const planned = usePageState((state) => state.planned);
  const machine = usePageState((state) => findMachine(state.settings));
  const unit = usePageState((state) => state.view.lengthUnit);
  const isSheet = usePageState(({ drawing }) => Boolean(drawing?.sheet));
  const { changeSettings } = useActions();
  if (!planned || !machine) return null;
  const { drawnBox, frameMm, unreachedCount } = planned;
  const doesTurnHelp =
    !isSheet && frameMm !== null && isReached(quarterTurnedBox(drawnBox, turningHeightMm(planned)), machine);
  const reach = formatSize(machine.widthMm, machine.heightMm, unit);
  return (
    <div className="out-of-reach">
      <p className="note note-error">
        {drawnBox.x0 < 0 || drawnBox.y0 < 0
          ? words.beforeHome(machine.name)
          : words.tooFar(machine.name, reach, formatSize(drawnBox.x1, drawnBox.y1, unit))}{" "}
        {words.lines(unreachedCount, formatCount(unreachedCount))}
        {!doesTurnHelp && ` ${words.whatToDo}`}
      </p>
      {doesTurnHelp && (
        <Button
          onClick={() => {
            const { xMm, yMm, widthMm, heightMm } = frameMm;
            const frame = { x0: xMm, y0: yMm, x1: xMm + widthMm, y1: yMm + heightMm };
            changeSettings("turn for machine", (settings) => ({
              ...settings,
              prepare: quarterTurned(
                settings.prepare,
                { frame, choice: planned.choice },
                { widthMm: planned.pageWidthMm, heightMm: planned.pageHeightMm },
              ),
            }));
          }}
        >
          {words.turn}
        </Button>
      )}
    </div>
  );
};
