/** Damaged DXF and HPGL: each gives a drawing with finite numbers or a PlotwrightError, and soon. */
import { expect, it } from "vitest";
import { PlotwrightError } from "../../../src/errors.js";
import { importDrawing } from "../../../src/import/registry.js";
import { cpuS, endWhenOver } from "../../support/watchdog.js";
import { generator, mutate } from "./support/mutate.js";

const CASES = 1_000;
/** Processor time that one file may take; and when a file counts as hanging, on a machine however loaded. */
const LONGEST_S = 2;
const HANGS_MS = 60_000;

const EDGES =
  "92 1|93 3|72 1|10 1|20 1|11 5|21 5|72 2|10 3|20 3|40 4|50 10|51 90|73 0|72 3|10 5|20 5|11 9|21 0|40 0.5|50 1|51 300|73 1|97 0";
const DXF = [
  "0 SECTION|2 HEADER|9 $INSUNITS|70 4|0 ENDSEC|0 SECTION|2 BLOCKS|0 BLOCK|8 0|2 B|10 0|20 0|0 LINE|8 0|10 0|20 0|11 1|21 1|0 ENDBLK|0 ENDSEC|0 SECTION|2 ENTITIES",
  "0 LWPOLYLINE|8 0|90 3|70 1|10 0|20 0|42 1|10 90|20 0|91 2|10 90|20 50",
  "0 INSERT|8 0|2 B|10 1|20 2|41 2|50 30|70 2|44 5",
  "0 SPLINE|8 0|70 8|71 3|72 8|73 4|40 0|40 0|40 0|40 0|40 1|40 1|40 1|40 1|10 0|20 0|10 0|20 9|10 9|20 9|10 9|20 0",
  "0 TEXT|8 0|62 1|10 1|20 9|11 50|21 50|72 3|73 2|40 5|1 %%c20 at 45%%d",
  "0 ATTRIB|8 0|10 1|20 1|40 3|1 hi|74 2|11 4|21 4",
  "0 MTEXT|8 0|10 9|20 6|40 2|41 30|44 1|71 3|11 1|21 0|3 first |1 {\\fArial|b1;Words} to break\\P\\S1/2; end",
  `0 HATCH|8 0|10 0|20 0|2 SOLID|70 1|91 2|92 2|72 1|73 1|93 2|10 2|20 4|42 1|10 6|20 4|42 1|97 0|${EDGES}|75 0|76 1`,
  "0 ENDSEC|0 EOF",
];
const FILES: readonly (readonly [string, string])[] = [
  [
    "a.dxf",
    DXF.flatMap((part) => part.split(/\|(?=\d+ )/))
      .join("\n")
      .replace(/^(\d+) /gm, "$1\n"),
  ],
  [
    "a.plt",
    "IN;SP1;IP0,0,4000,4000;SC0,10,0,10;PU1,1;PD2,2,3,1;SC;SI0.3,0.45;PU400,500;LBPump 1:50\u0003LO15;DI1,1;SL0.3;LBup\u0003DT#;SR1,2;DR1,1;CP;CP2,1;LBxx\r\ny#PU10,10;PD;AA20,20,90;CI50;EA100,200;PE<=abc;PU;SP0;",
  ],
];
/** The first eight stand in for numbers. */
const PIECES = [
  ..."NaN 1e300 -1e308 1e-300 -1 0 99999 -0.5 10 72 92 HATCH EOF LB PE SI PU ; , % \\P \\S { } %% é".split(
    " ",
  ),
  "\u0003",
  "\n",
  "\u0000",
];

it(`damaged DXF and HPGL neither crash, nor hang, nor let a NaN through, ${CASES} times`, () => {
  const drawn = FILES.map(() => 0);
  for (let i = 0; i < CASES; i++) {
    const [name, file] = FILES[i % FILES.length];
    const text = mutate(file, PIECES, generator(i));
    try {
      const mark = process.cpuUsage();
      const { paths, widthMm, heightMm } = endWhenOver(HANGS_MS, () => importDrawing(name, text));
      expect(cpuS(mark), text).toBeLessThan(LONGEST_S);
      expect(paths.coords.every(Number.isFinite), text).toBe(true);
      expect(widthMm > 0 && heightMm > 0 && Number.isFinite(widthMm + heightMm), text).toBe(true);
      drawn[i % FILES.length]++;
    } catch (error) {
      if (!(error instanceof PlotwrightError)) throw new Error(`seed ${i}: ${text}`, { cause: error });
      expect(error.code, text).toBe("bad-file");
    }
  }
  // Most of HPGL is read whatever it is; a DXF out of step is not.
  expect(Math.min(...drawn)).toBeGreaterThan(CASES / 20);
});
