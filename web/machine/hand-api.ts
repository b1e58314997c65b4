/** Moves by hand, machines and the console: requests of parts that are fetched later. */
import {
  commandAnswerSchema,
  machineProfileSchema,
  plotterSchema,
  type BoxMm,
  type CommandAnswer,
  type FrameRequest,
  type PlotSettings,
  type Plotter,
} from "../../src/schema/index.js";
import type { MachineProfile } from "../../src/index.js";
import { okSchema } from "../api/client.js";
import { currentPlotter, type PageStore } from "../state/store.js";
import type { Actions } from "../state/actions.js";

export type HandApi = ReturnType<typeof handApi>;

/** Each answers null where it failed; the user has been told then. Speeds and machine are those set on the page. */
export const handApi = (store: PageStore, { ask, attempt, loadMachines, notify }: Actions) => {
  const path = (move: string): string =>
    `/plotters/${encodeURIComponent(currentPlotter(store.getState())?.id ?? "")}/${move}`;
  const move = (
    name: string,
    body: Record<string, unknown>,
    settings?: PlotSettings,
  ): Promise<Plotter | null> =>
    attempt(name, () =>
      ask(plotterSchema, "POST", path(name), { ...body, settings: settings ?? store.getState().settings }),
    );
  return {
    notify,
    walk: (xMm: number, yMm: number) => move("walk", { xMm, yMm }),
    jog: (dxMm: number, dyMm: number, settings?: PlotSettings) => move("jog", { dxMm, dyMm }, settings),
    setHome: () => move("set-home", {}),
    cyclePen: () => move("cycle-pen", {}),
    testPatch: () => move("test-patch", {}),
    frameBox: (boxMm: BoxMm) => move("frame", { boxMm } satisfies Partial<FrameRequest>),
    square: (sizeMm: number, settings: PlotSettings) => move("square", { sizeMm }, settings),
    servo: (pos: number, settings: PlotSettings) => move("servo", { pos }, settings),
    command: (line: string): Promise<CommandAnswer> =>
      ask(commandAnswerSchema, "POST", path("command"), { line }),
    saveMachine: async (profile: MachineProfile): Promise<MachineProfile | null> => {
      const route = `/machines/${encodeURIComponent(profile.id)}`;
      const saved = await attempt("machine", () => ask(machineProfileSchema, "PUT", route, profile));
      if (saved) await loadMachines();
      return saved;
    },
    removeMachine: async ({ id }: MachineProfile): Promise<void> => {
      await attempt("machine", () => ask(okSchema, "DELETE", `/machines/${encodeURIComponent(id)}`));
      await loadMachines();
    },
  };
};
