/** Warns about changed settings that the machine's controller does not use. */
import type { JobSettings } from "../drivers/machine-job.js";
import { controllerOf } from "../drivers/registry.js";
import type { MachineProfile } from "../machines/profile.js";
import { DEFAULT_MOTION } from "../settings/motion.js";
import { DEFAULT_PEN } from "../settings/pen.js";

/** One warning, or none. Settings that are left out or have their default are not named. */
export function unusedSettings({ motion, pen }: JobSettings, machine: MachineProfile): string[] {
  const { unusedSettings: unused = {} } = controllerOf(machine);
  const changed = Object.keys(unused).filter((path) => {
    const [usual = null] = valuesAt({ motion: DEFAULT_MOTION, pen: DEFAULT_PEN }, path.split("."));
    return valuesAt({ motion, pen }, path.split(".")).some((value) => value !== usual);
  });
  if (changed.length === 0) return [];
  const labels = changed.map((path) => unused[path]).join(", ");
  return [`${machine.name} does not use these settings, because its controller plans by itself: ${labels}.`];
}

/** The values at a path such as "motion.layers.*.cornerMm", without those that are left out or null. */
function valuesAt(value: unknown, [key, ...rest]: readonly string[]): unknown[] {
  if (value === null || value === undefined) return [];
  if (key === undefined) return [value];
  const fields = value as Readonly<Record<string, unknown>>;
  const next = key === "*" ? Object.values(fields) : [fields[key]];
  return next.flatMap((one) => valuesAt(one, rest));
}
