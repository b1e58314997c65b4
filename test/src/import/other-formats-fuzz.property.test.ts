/**
 * Damaged DXF and HPGL: each gives a drawing with finite numbers or a PlotwrightError, within a time limit;
 * every tenth is prepared and planned too. PLOTWRIGHT_FUZZ_CASES: number of cases, PLOTWRIGHT_FUZZ_FIRST:
 * first seed.
 */
import { expect, it } from "vitest";
import { planAndCompile } from "../../../host/planning/stages.js";
import { PlotwrightError } from "../../../src/errors.js";
import { importDrawing } from "../../../src/import/registry.js";
import type { Drawing } from "../../../src/index.js";
import { OLDEST_PLANNED_FIRMWARE } from "../../../src/drivers/ebb/compile/ebb-job.js";
import { prepareJob, machineOf } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { cpuS, endWhenOver } from "../../support/clocks/watchdog.js";
import { generator, mutate } from "../../support/import/mutate.js";
import { countFor } from "../../support/runs/full-run.js";

const CASES = countFor("PLOTWRIGHT_FUZZ_CASES", 2_000, 300);
const FIRST = Number(process.env["PLOTWRIGHT_FUZZ_FIRST"] ?? 0);
const PLANNED_EACH = 10;
/** Max processor time per file, and the time after which a file counts as hanging, however loaded the machine. */
const LONGEST_S = 2;
const HANGS_MS = 60_000;

const EDGES =
  "92 1|93 3|72 1|10 1|20 1|11 5|21 5|72 2|10 3|20 3|40 4|50 10|51 90|73 0|72 3|10 5|20 5|11 9|21 0|40 0.5|50 1|51 300|73 1|97 0";
const DXF = [
  "0 SECTION|2 HEADER|9 $INSUNITS|70 4|0 ENDSEC|0 SECTION|2 TABLES|0 TABLE|2 VPORT|70 1|0 VPORT|2 *ACTIVE|10 0|20 0|0 ENDTAB|0 TABLE|2 LTYPE|0 LTYPE|2 DASH|73 2|40 3|49 1|49 -2|0 ENDTAB|0 TABLE|2 LAYER|70 2|0 LAYER|2 0|62 7|0 LAYER|2 a|62 -1|70 1|0 ENDTAB|0 ENDSEC|0 SECTION|2 BLOCKS|0 BLOCK|8 0|2 B|10 0|20 0|0 LINE|8 0|10 0|20 0|11 1|21 1|0 ENDBLK|0 ENDSEC|0 SECTION|2 ENTITIES",
  "0 LWPOLYLINE|8 0|90 3|70 1|10 0|20 0|42 1|10 90|20 0|91 2|10 90|20 50",
  "0 POLYLINE|8 0|66 1|70 1|10 0|20 0|0 VERTEX|8 0|10 0|20 0|42 1|0 VERTEX|8 0|10 9|20 0|0 VERTEX|8 0|10 9|20 9|70 16|0 SEQEND|8 0",
  "0 CIRCLE|8 a|10 5|20 5|40 2|0 ARC|8 0|10 5|20 5|40 2|50 10|51 80|0 ELLIPSE|8 0|10 5|20 5|11 3|21 1|40 0.5|41 0|42 6",
  "0 SOLID|8 0|10 0|20 0|11 1|21 0|12 0|22 1|0 3DFACE|8 0|10 0|20 0|11 1|21 0|12 1|22 1|13 0|23 1|0 POINT|8 0|10 2|20 3|0 DIMENSION|2 B|8 0|10 1|20 1",
  "0 INSERT|8 0|2 B|10 1|20 2|41 2|50 30|70 2|44 5",
  "0 SPLINE|8 0|70 8|71 3|72 8|73 4|40 0|40 0|40 0|40 0|40 1|40 1|40 1|40 1|10 0|20 0|10 0|20 9|10 9|20 9|10 9|20 0",
  "0 TEXT|8 0|62 1|10 1|20 9|11 50|21 50|72 3|73 2|40 5|1 %%c20 at 45%%d",
  "0 ATTRIB|8 0|10 1|20 1|40 3|1 hi|74 2|11 4|21 4",
  "0 MTEXT|8 0|10 9|20 6|40 2|41 30|44 1|71 3|11 1|21 0|3 first |1 {\\fArial|b1;Words} to break\\P\\S1/2; end",
  `0 HATCH|8 0|10 0|20 0|2 SOLID|70 1|91 2|92 2|72 1|73 1|93 2|10 2|20 4|42 1|10 6|20 4|42 1|97 0|${EDGES}|75 0|76 1`,
  "0 LINE|8 0|6 DASH|48 2|10 0|20 0|11 9|21 9|0 LEADER|8 0|71 1|3 D|10 0|20 0|10 9|20 9|0 TRACE|8 0|10 0|20 0|11 1|21 0|12 0|22 1|13 1|23 1",
  "0 SPLINE|8 0|70 4|71 2|40 0|40 0|40 0|40 1|40 1|40 1|41 1|41 0.7|41 1|10 0|20 0|10 9|20 0|10 9|20 9|0 SPLINE|8 0|70 1|12 0|22 1|11 0|21 0|11 5|21 7|11 15|21 2",
  "0 MLINE|8 0|71 2|11 0|21 0|13 0|23 1|74 1|41 2|74 1|41 -1|11 9|21 0|13 0|23 1|74 1|41 2|74 1|41 -1|0 XLINE|8 0|10 1|20 1|11 1|21 0|0 RAY|8 0|10 1|20 1|11 0|21 1",
  "0 MESH|8 0|92 3|10 0|20 0|10 9|20 0|10 9|20 9|93 4|90 3|90 0|90 1|90 2|0 POLYLINE|8 0|70 16|71 1|72 2|0 VERTEX|10 0|20 0|0 VERTEX|10 9|20 0|0 SEQEND",
  "0 DIMENSION|8 0|2 no|70 1|10 9|20 9|13 0|23 0|14 9|24 0|0 MULTILEADER|8 0|300 CONTEXT_DATA{|41 4|290 1|304 Oak|12 4|22 2|302 LEADER{|10 4|20 1|304 LEADER_LINE{|10 0|20 0|305 }|303 }|301 }",
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
    [
      "IN;SP1;IP0,0,4000,4000;SC0,10,0,10;PU1,1;PD2,2,3,1;SC;SI0.3,0.45;PU400,500;LBPump 1:50\u0003LO15;DI1,1;SL0.3;",
      "LBup\u0003DT#;SR1,2;DR1,1;CP;CP2,1;LBxx\r\ny#PU10,10;PD;AA20,20,90;CI50,20;EA100,200;PE<=abc;PU;",
      'CO "x;PD";SC0,9,0,7,1,20,30;IW1,1,8,6;RO90;IR10,10,90;AT5,5,9,0;RT1,1,2,0,30;BZ1,2,3,2,4,0;BR1,2,3,2,4,0;',
      "LT-3,2;UL3,1,2,3;PM0;PD5,1,5,5;CI2;PM1;PU6,6;PD7,6,6,7;PM2;FT3,1,45;FP;FT4;EP;EW3,10,200,45;WG3,0,360;CT1;",
      "SM*;PD1,1;SM;UC4,7,99,0,1,-4,0;TL2,1;XT;YT;PC2,9,8,7;BLa#PB;\u001b%0A\u001b&l1O\u001b%1BLT0;PD3,3;PU;SP0;",
    ].join(""),
  ],
];
/** The first eight replace numbers. */
const PIECES = [
  ..."NaN 1e300 -1e308 1e-300 -1 0 99999 -0.5 10 72 92 VERTEX SEQEND LAYER ENDTAB ENDBLK ENDSEC HATCH EOF LB PE SI PU ; , % \\P \\S { } %% é".split(
    " ",
  ),
  "\u0003",
  "\n",
  "\u0000",
];

const machine = machineOf(DEFAULT_PLOT_SETTINGS);
const PLAN_ALL = {
  from: null,
  until: null,
  startXMm: 0,
  startYMm: 0,
  settings: DEFAULT_PLOT_SETTINGS,
  firmware: OLDEST_PLANNED_FIRMWARE,
  board: { steps1: 0, steps2: 0, acc1: 0, acc2: 0 },
};

it(`damaged DXF and HPGL never crash, hang, or return a NaN, ${CASES} times`, async () => {
  const drawn = FILES.map(() => 0);
  for (let i = FIRST; i < FIRST + CASES; i++) {
    const [name, file] = FILES[i % FILES.length];
    const text = mutate(file, PIECES, generator(i));
    let drawing: Drawing;
    try {
      const mark = process.cpuUsage();
      drawing = await endWhenOver(HANGS_MS, () => importDrawing(name, text));
      const { paths, widthMm, heightMm } = drawing;
      expect(cpuS(mark), text).toBeLessThan(LONGEST_S);
      expect([...paths.coords, ...paths.strokeWidth].every(Number.isFinite), text).toBe(true);
      expect(widthMm > 0 && heightMm > 0 && Number.isFinite(widthMm + heightMm), text).toBe(true);
      drawn[i % FILES.length]++;
    } catch (error) {
      if (!(error instanceof PlotwrightError)) throw new Error(`seed ${i}: ${text}`, { cause: error });
      expect(error.code, text).toBe("bad-file");
      continue;
    }
    if (Math.floor(i / FILES.length) % PLANNED_EACH !== 0) continue;
    try {
      await endWhenOver(HANGS_MS, () => {
        const { prepared } = prepareJob(drawing, DEFAULT_PLOT_SETTINGS, machine);
        planAndCompile(prepared, PLAN_ALL, machine);
      });
    } catch (error) {
      if (!(error instanceof PlotwrightError)) throw new Error(`seed ${i}: ${text}`, { cause: error });
    }
  }
  // Nearly any HPGL can be read; a DXF that is out of step cannot.
  expect(Math.min(...drawn)).toBeGreaterThan(CASES / 20);
});
