/**
 * Settings stored or written before the times of the pen came from the machine's servo: `liftMs` and `dropMs` were the
 * whole waits. They become extra waits:
 *
 *   the old default    0: nobody chose it
 *   with a rate set    unchanged: it already was an extra wait, after the move at that rate
 *   any other value    the difference to the time that the machine's servo takes between the heights: the same wait as before
 */
import type { MachineProfile } from "../machines/profile.js";
import { findMachine } from "../machines/profiles.js";
import { dropTime, liftTime, timedPen } from "../plan/pen/pen-times.js";
import { DEFAULT_PEN, PEN_TABLE, type PenSettings } from "../settings/pen.js";

type Values = Readonly<Record<string, unknown>>;
export type OldWait = (typeof OLD)[number]["old"];

const OLD = [
  { old: "liftMs", oldDefault: 250, extra: "extraLiftMs", rate: "liftPctPerS", time: liftTime },
  { old: "dropMs", oldDefault: 300, extra: "extraDropMs", rate: "dropPctPerS", time: dropTime },
] as const;

/**
 * The same settings with extra waits: those of a job, of a plotter with its presets, or a part of them. Anything else is
 * returned unchanged.
 *
 * @param machine the machine of settings that name none; null: unknown, then AxiDraw's servo is taken
 */
export function withExtraWaits(settings: unknown, machine: MachineProfile | null = null): unknown {
  if (!isRecord(settings)) return settings;
  const { pen, presets } = settings;
  const own = machineIn(settings) ?? machine;
  return {
    ...settings,
    ...(isRecord(pen) && { pen: penWithExtraWaits(pen, own) }),
    ...(Array.isArray(presets) && { presets: presets.map((preset) => withExtraWaits(preset, own)) }),
  };
}

function machineIn({ machine, customMachine }: Values): MachineProfile | null {
  if (typeof machine !== "string") return null;
  const custom = isRecord(customMachine) && isRecord(customMachine["controller"]) ? customMachine : null;
  return findMachine({ machine, customMachine: custom as MachineProfile | null });
}

function penWithExtraWaits(pen: Values, machine: MachineProfile | null): Values {
  const { layers } = pen;
  const heights = { ...DEFAULT_PEN, ...pen } as PenSettings;
  const migrated = withoutOldWaits(pen, heights, machine);
  if (!isRecord(layers)) return migrated;
  const ofLayers = Object.entries(layers).map(([id, own]) => {
    if (!isRecord(own)) return [id, own];
    return [id, withoutOldWaits(own, { ...heights, ...own }, machine)];
  });
  return { ...migrated, layers: Object.fromEntries(ofLayers) };
}

function withoutOldWaits(values: Values, pen: PenSettings, machine: MachineProfile | null): Values {
  const migrated: Record<string, unknown> = { ...values };
  for (const { old, oldDefault, extra } of OLD) {
    const waitMs = values[old];
    delete migrated[old];
    if (typeof waitMs !== "number" || extra in values) continue;
    migrated[extra] = waitMs === oldDefault ? 0 : extraWaitOf(old, waitMs, pen, machine);
  }
  return migrated;
}

/** The extra wait with which a pen waits as long as with the whole wait `waitMs`, or as near to it as is allowed. */
export function extraWaitOf(
  old: OldWait,
  waitMs: number,
  pen: PenSettings,
  machine: MachineProfile | null,
): number {
  const { extra, rate, time } = OLD.find((one) => one.old === old)!;
  const usual = { ...timedPen(pen, machine), [extra]: 0 };
  const usualMs = pen[rate] ? 0 : Math.ceil(1_000 * time(usual, pen.upPct));
  const { min, max } = PEN_TABLE[extra];
  return Math.min(max, Math.max(min, waitMs - usualMs));
}

const isRecord = (value: unknown): value is Values =>
  typeof value === "object" && value !== null && !Array.isArray(value);
