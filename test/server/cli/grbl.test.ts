/** `plan` and `plot` for a machine with a Grbl: its profile is a file. */
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { beforeEach, expect, it } from "vitest";
import { GRBL } from "../../support/machines/machine.js";
import { cli } from "../../support/processes/command-line.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SAMPLE = join(import.meta.dirname, "../../../samples/whirling-triangles.svg");

let dir: string;
let profile: string;
beforeEach(() => {
  dir = folderOfTest();
  profile = join(dir, "my-grbl.json");
  writeFileSync(profile, JSON.stringify(GRBL));
});

it("plan writes G-code for a Grbl, with the pen up at both ends", async () => {
  const { code, out } = await cli("plan", SAMPLE, "--machine-file", profile, "--commands", "-");
  expect(code).toBe(0);
  const lines = out.trim().split("\n");
  expect(lines.slice(0, 3)).toEqual(["G21G90G94", "G1Z5F3000", "G4P0.1"]);
  expect(lines.slice(-2)).toEqual([expect.stringMatching(/^G1X0Y0/), "G4P0"]);
  expect(lines.filter((line) => !/^G1[XZ][-\d.]+(Y[-\d.]+)?(F[\d.]+)?$|^G4P[\d.]+$/.test(line))).toEqual([
    "G21G90G94",
  ]);
  expect(lines.filter((line) => line.startsWith("G1Z0")).length).toBe(
    lines.filter((line) => line.startsWith("G1Z5")).length - 1,
  );
});

it("plot draws on a virtual Grbl", async () => {
  const options = ["--machine-file", profile, "--device", "virtual", "--virtual-speed", "300", "--data", dir];
  const { code, err } = await cli("plot", SAMPLE, ...options);
  expect({ code, err }).toEqual({
    code: 0,
    err: expect.stringMatching(
      /^whirling-triangles\.svg: drawn [^\n]*, 100 %\nPlotting whirling-triangles\.svg\.\n(?:\d+ % [^\n]*\n)*Done: whirling-triangles\.svg, after/,
    ) as string,
  });
});
