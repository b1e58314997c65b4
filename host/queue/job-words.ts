/** Names of jobs, and what a job's message says about a plot that was held or interrupted. */
import { findsHome, HEIGHT_AGAIN, homeAgain, machineOf, tilesOf } from "../../src/internal.js";
import type { Job, PlotSettings, PlotWait, Plotter } from "../../src/schema/index.js";
import { OTHER_BOARD } from "../plotter/board-id.js";

export const SERVER_STOPPED =
  "The server stopped while this was plotting. Check pen and paper, then resume where it stopped.";

/** What is plotted on each sheet of paper: several if the drawing is spread over them. */
export const sheetsOf = (
  name: string,
  settings: PlotSettings,
): readonly { readonly name: string; readonly settings: PlotSettings }[] => {
  const tiles = tilesOf(settings.prepare);
  return tiles.map((prepare) => ({
    name: tiles.length === 1 ? name : `${name} (sheet ${prepare.tile} of ${tiles.length})`,
    settings: { ...settings, prepare },
  }));
};

export const NEW_PAPER = "This is another sheet of a drawing: put in new paper, then start it.";

export const penWords = ({ penName, layerName }: PlotWait): string =>
  penName === null ? `Put in the pen for "${layerName}".` : `Put in "${penName}" for "${layerName}".`;

/** What a job has after an emergency stop of its plotter. */
export const stoppedJob = ({ xMm }: Pick<Plotter, "xMm">): Pick<Job, "stopped" | "message"> => ({
  stopped: true,
  message:
    xMm === null
      ? "Stopped at once, and the pen was lifted. The board does not know where it stopped."
      : "Stopped at once, and the pen was lifted. The board still knows its position, so the plot can be resumed. The line may have a small mark there.",
});

/** What the user is told about a pen whose height is unsure. */
export const heightWords = ({ heightUnsure }: Pick<Plotter, "heightUnsure">): string =>
  heightUnsure ? ` The board does not know how high its pen is: ${HEIGHT_AGAIN}.` : "";

/** For a job that is continued: whether its board knows its position, or is another one. `found`: its plotter. */
export function recoveredWords(
  { settings, wait }: Pick<Job, "settings" | "wait">,
  position: "known" | "lost" | "other",
  found: Pick<Plotter, "heightUnsure">,
): string {
  const again = homeAgain(findsHome(machineOf(settings)));
  const words =
    position === "known"
      ? "The board still knows its position. Check it with the pen up, then resume."
      : `${position === "other" ? OTHER_BOARD : "The board has lost its position"}: ${again}. The line may overlap a little where it continues.`;
  const all = words + heightWords(found);
  return wait === null ? all : `${penWords(wait)} ${all}`;
}
