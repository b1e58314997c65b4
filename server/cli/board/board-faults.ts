/** Faults of a virtual machine, triggered by typed lines, for authors of drivers. */
import type { VirtualBench, VirtualMachine } from "../../../src/internal.js";

/** Triggers the fault; returns a message for the user. */
export function applyFault(machine: VirtualMachine, { faults }: VirtualBench, line: string): string {
  const [word = "", value] = line.trim().toLowerCase().split(/\s+/);
  const fault = Object.hasOwn(faults, word) ? faults[word] : undefined;
  if (fault === undefined) return faultHelp(faults);
  return fault.apply(machine, value) ? `${line.trim()}: done.\n` : `Type ${fault.usage}: ${fault.does}.\n`;
}

export function faultHelp(faults: VirtualBench["faults"]): string {
  const rows = Object.values(faults).map(({ usage, does }) => `  ${usage.padEnd(18)} ${does}\n`);
  return `Faults to type:\n${rows.join("")}`;
}
