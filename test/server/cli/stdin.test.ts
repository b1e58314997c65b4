/** Stdin, which can be read for one thing only. */
import { afterEach, describe, expect, it, vi } from "vitest";
import { cli } from "../../support/processes/command-line.js";

const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm"><path d="M1 1H9" stroke="red"/></svg>';
let stdin = "";
vi.mock("node:fs", async (importOriginal) => {
  const fs = await importOriginal<typeof import("node:fs")>();
  const readFileSync = (path: number, ...rest: []): unknown =>
    path === 0 ? Buffer.from(stdin) : fs.readFileSync(path, ...rest);
  return { ...fs, readFileSync };
});
afterEach(() => vi.resetModules());

describe("stdin", () => {
  it("is the drawing, or the settings, and not both", async () => {
    stdin = SVG;
    expect((await cli("plan", "-", "--json")).code).toBe(0);
    const both = await cli("plan", "-", "--config", "-");
    expect(both).toEqual({
      code: 2,
      out: "",
      err: "plotwright: Standard input can't be both the drawing and --config: give one of them a file.\n",
    });
  });
});
