/** Typed lines that would stop a Grbl from answering, in every form in which it reads them. */
import { expect, it } from "vitest";
import { whyRefused } from "../../../../src/drivers/grbl/console-lines.js";

it.each([
  ["M0", /wait for a resume.*G4P/],
  ["m 00 (pause)", /resume/],
  ["N10 G1 X5 M01", /resume/],
  ["M1.0", /resume/],
  ["$slp", /Switch the motors off on the page/],
  ["$ H", /Home the machine on the page/],
  ["$HX", /Home the machine on the page/],
  ["$C", /preview/],
  ["G1 X1 !", /act at once/],
  ["G1 X1 ; Ä", /79 plain characters/],
])("refuses %s", (line, why) => expect(whyRefused(line)).toMatch(why));

it.each([
  "M3 S100",
  "M10",
  "M1.5",
  "G0 X1 ; M0",
  "G1 (M0) X1",
  "$$",
  "$I",
  "$#",
  "$X",
  "$110=500",
  "$J=G91X1F600",
])("sends %s", (line) => expect(whyRefused(line)).toBeNull());
