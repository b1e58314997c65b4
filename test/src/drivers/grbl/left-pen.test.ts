/** What the modes of a Grbl tell of a pen that own lines move. */
import { describe, expect, it } from "vitest";
import { leftPen, type LeftPen } from "../../../../src/drivers/grbl/machine/left-pen.js";
import { penLiftOf } from "../../../../src/drivers/grbl/model/pen-lift.js";
import { DEFAULT_PEN } from "../../../../src/index.js";
import { GRBL_LINES } from "../../../support/machines/machine.js";

const modesWith = (outputs: string): string => `[GC:G1 G54 G17 G21 G90 G94 ${outputs}]`;

function left(penUpLines: string, penDownLines: string, modes: string, isInPlot = true): LeftPen {
  const machine = { ...GRBL_LINES, controller: { ...GRBL_LINES.controller, penUpLines, penDownLines } };
  return leftPen(penLiftOf(machine), 0, modes, DEFAULT_PEN, null, isInPlot);
}

describe("a pen that own lines move", () => {
  it.each([
    ["M5", "M3 S1000", "M5 M9 T80 F3000 S0", "M3 M9 T80 F3000 S1000"],
    ["m03s90 (to S10)", "M3 S40 ; not M5", "M3 M9 T80 F0 S90.0", "M3 M9 T80 F0 S40.0"],
    ["M9\nG4P0.2", "M8\nG4P0.2", "M5 M9 T80 F3000 S0", "M5 M8 T80 F3000 S0"],
    ["S90", "M3 S70\nG4P0.1\nS40", "M3 M9 T80 F0 S90", "M3 M9 T80 F0 S40"],
  ])("is up after %j, down after %j, and lifted if a plot was not finished", (up, down, isUp, isDown) => {
    expect(left(up, down, modesWith(isUp))).toEqual({ isUp: true, mustLift: false });
    expect(left(up, down, modesWith(isDown))).toEqual({ isUp: false, mustLift: true });
    expect(left(up, down, modesWith(isDown), false)).toEqual({ isUp: false, mustLift: false });
  });

  it.each([
    ["M3 S90", "M3 S40", "M3 M9 T80 F0 S70"],
    ["G1Z5F600", "G1Z0F600", "M5 M9 T80 F600 S0"],
    ["M3 S90", "M3 S40", ""],
  ])("is not moved if the modes do not tell where it is: %j, %j, %j", (up, down, outputs) => {
    expect(left(up, down, modesWith(outputs))).toEqual({ isUp: false, mustLift: false });
  });
});
