/** The options and models that docs/ names for users of other programs exist. */
import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { COMMANDS } from "../../../server/cli/commands.js";
import { buildProgram } from "../../../server/cli/program.js";
import { MACHINES } from "../../../src/index.js";
import { CaughtIo } from "../../support/processes/command-line.js";

/** The cells of the column "plotwright" in the tables that translate another program's options. */
function translationsIn(markdown: string): string[] {
  let isInTable = false;
  return markdown.split("\n").flatMap((line) => {
    const cell = line.startsWith("|") ? (line.split(/(?<!\\)\|/)[2]?.trim() ?? "") : "";
    if (cell === "plotwright") isInTable = true;
    if (cell === "") isInTable = false;
    return isInTable ? [cell] : [];
  });
}

describe("the pages for users of other programs", () => {
  const read = (name: string): string =>
    readFileSync(new URL(`../../../docs/${name}`, import.meta.url), "utf8");

  it.each(["from-axidraw.md", "from-saxi.md"])("translate to options that exist in %s", async (name) => {
    const io = new CaughtIo();
    const names = COMMANDS.map((one) => one.name);
    const program = await buildProgram(names, { io, version: "1", setExitCode: () => undefined });
    const known = new Set(
      [program, ...program.commands].flatMap(({ options }) => options.map(({ long }) => long)),
    );
    const cells = translationsIn(read(name));
    const named = cells.flatMap((cell) => cell.match(/--[a-z][a-z-]*/g) ?? []);
    expect(named.length).toBeGreaterThan(20);
    expect(named.filter((flag) => !known.has(flag))).toEqual([]);
    const commands = cells.flatMap((cell) =>
      [...cell.matchAll(/`plotwright ([a-z][\w-]*)/g)].map((one) => one[1]),
    );
    expect(commands.filter((command) => command === undefined || !names.includes(command))).toEqual([]);
  });

  it.each(["from-axidraw.md", "from-saxi.md", "brushless-servo.md"])("name known models in %s", (name) => {
    const ids = [...read(name).matchAll(/`(?:--machine )?((?:axidraw|nextdraw)-[\w-]+)`/g)].map(
      (one) => one[1],
    );
    expect(ids.length).toBeGreaterThan(0);
    expect(ids.filter((id) => !MACHINES.some((machine) => machine.id === id))).toEqual([]);
  });
});
