/** The user's own machines: their ids, and the one that a measured plotter becomes. */
import { MACHINES } from "./profiles.js";
import type { MachineProfile, Springs } from "./profile.js";

const MAX_ID = 60;

/**
 * A free id that is valid as a file name: "My Plotter" -> "my-plotter", "my-plotter-2" … `own`: the user's machines,
 * whose ids are taken like those of the built-in ones.
 */
export function freeId(name: string, own: readonly MachineProfile[]): string {
  const plain = name
    .normalize("NFD")
    .replace(/[\u0300-\u036f]/g, "")
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "-")
    .replace(/^-+|-+$/g, "")
    .slice(0, MAX_ID - 3);
  const base = plain === "" ? "plotter" : plain;
  const isTaken = (wanted: string): boolean => [...MACHINES, ...own].some(({ id }) => id === wanted);
  let id = base;
  for (let n = 2; isTaken(id); n++) id = `${base}-${n}`;
  return id;
}

/** The machine with these springs. A built-in machine can't be changed, so it is a copy of it. */
export function measuredMachine(
  machine: MachineProfile,
  springs: Springs,
  own: readonly MachineProfile[],
): MachineProfile {
  const measured = {
    ...machine,
    springs: { ...springs, xHz: tenth(springs.xHz), yHz: tenth(springs.yHz) },
  };
  if (!MACHINES.some(({ id }) => id === machine.id)) return measured;
  // Two plotters of one model are measured separately.
  const plain = `${machine.name}, measured`;
  let name = plain;
  for (let n = 2; own.some((other) => other.name === name); n++) name = `${plain} ${n}`;
  return { ...measured, id: freeId(name, own), name };
}

const tenth = (hz: number): number => Math.round(10 * hz) / 10;
