/** Moves by hand, machines and the console, for the plotter that the page shows. */
import type { MachineProfile } from "../../src/index.js";
import type { BoxMm, CommandAnswer, PlotSettings, Plotter } from "../../src/schema/index.js";
import type { Backend, HandBackend } from "../backend/backend.js";
import type { Actions } from "../state/actions.js";
import { currentPlotter, type PageStore } from "../state/store.js";

export type HandApi = ReturnType<typeof handApi>;

type Move = (hand: HandBackend, plotterId: string, settings: PlotSettings) => Promise<Plotter>;

/** Each returns null if it failed, and the user has seen why. Uses the page's speeds and machine. */
export const handApi = (
  store: PageStore,
  backend: Backend,
  { attempt, loadMachines, notify }: Pick<Actions, "attempt" | "loadMachines" | "notify">,
) => {
  const plotterId = (): string => currentPlotter(store.getState())?.id ?? "";
  const move = (name: string, run: Move, settings?: PlotSettings): Promise<Plotter | null> =>
    attempt(name, async () => run(await backend.hand(), plotterId(), settings ?? store.getState().settings));
  return {
    notify,
    walk: (xMm: number, yMm: number) => move("walk", (hand, ...of) => hand.walk(...of, xMm, yMm)),
    jog: (dxMm: number, dyMm: number, settings?: PlotSettings) =>
      move("jog", (hand, ...of) => hand.jog(...of, dxMm, dyMm), settings),
    setHome: () => move("set-home", (hand, ...of) => hand.setHome(...of)),
    cyclePen: () => move("cycle-pen", (hand, ...of) => hand.cyclePen(...of)),
    testLine: () => move("test-line", (hand, ...of) => hand.testLine(...of)),
    testPatch: () => move("test-patch", (hand, ...of) => hand.testPatch(...of)),
    frameBox: (boxMm: BoxMm) => move("frame", (hand, ...of) => hand.frameBox(...of, boxMm)),
    square: (sizeMm: number, settings: PlotSettings) =>
      move("square", (hand, ...of) => hand.square(...of, sizeMm), settings),
    servo: (pos: number, settings: PlotSettings) =>
      move("servo", (hand, ...of) => hand.servo(...of, pos), settings),
    command: async (line: string): Promise<CommandAnswer> =>
      (await backend.hand()).command(plotterId(), line),
    saveMachine: async (profile: MachineProfile): Promise<MachineProfile | null> => {
      const saved = await attempt("machine", () => backend.saveMachine(profile));
      if (saved) await loadMachines();
      return saved;
    },
    removeMachine: async ({ id }: MachineProfile): Promise<void> => {
      await attempt("machine", () => backend.removeMachine(id));
      await loadMachines();
    },
  };
};
