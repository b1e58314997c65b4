/** The table of HPGL commands: complete, the same as in the documentation, and true for each command. */
import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import type { Drawing } from "../../../../src/drawing/drawing.js";
import { COMMAND_GROUPS } from "../../../../src/import/hpgl/hpgl-commands.js";
import { importDrawing } from "../../../../src/import/registry.js";
import { codes, shapesOf } from "../../../support/import/shapes.js";

const ETX = "\u0003";
const hpgl = (text: string): Promise<Drawing> => importDrawing("a.plt", text);
const LINE = "SP1;PU0,0;PD1000,0;PU;";

/** By command: a file in which it makes a difference. The command is between « and ». */
const EXAMPLES: Readonly<Record<string, string>> = {
  PU: "PU0,0;PD400,0;«PU800,0;»PD1200,0;",
  PD: "PU0,0;«PD400,0;»PU;",
  PA: "PU0,0;PD;«PA400,0;»PU;",
  PR: "PU400,0;PD;«PR;»PD0,400;PU;",
  PE: `PU0,0;«PE=\u00e3\u00e3;»`,
  AA: "PU1000,0;PD;«AA0,0,90;»PU;",
  AR: "PU1000,0;PD;«AR-1000,0,90;»PU;",
  AT: "PU0,0;PD;«AT500,500,1000,0;»PU;",
  RT: "PU0,0;PD;«RT500,500,1000,0;»PU;",
  BZ: "PU0,0;PD;«BZ0,500,1000,500,1000,0;»PU;",
  BR: "PU0,0;PD;«BR0,500,1000,500,1000,0;»PU;",
  CI: "PU0,0;«CI500;»",
  CT: "PU0,0;«CT1;»CI1000,60;",
  EA: "PU0,0;«EA400,400;»",
  ER: "PU0,0;«ER400,400;»",
  EW: "PU0,0;«EW400,0,90;»",
  RA: "PU0,0;«RA400,400;»",
  RR: "PU0,0;«RR400,400;»",
  WG: "PU0,0;«WG400,0,90;»",
  PM: "PU0,0;«PM0;»PD400,0,400,400;PM2;EP;",
  EP: "PU0,0;PM0;PD400,0,400,400;PM2;«EP;»",
  FP: "PU0,0;PM0;PD400,0,400,400;PM2;«FP;»",
  FT: "PU0,0;«FT3,100;»RA1000,1000;",
  AC: "PU0,0;PD0,9;PU0,0;FT3,100;«AC0,50;»RA1000,1000;",
  LT: "«LT2;»PU0,0;PD4000,0;PU;",
  UL: "«UL2,10,90;»LT2;PU0,0;PD4000,0;PU;",
  SP: "«SP2;»PU0,0;PD400,0;PU;",
  PC: "«PC1,255,0,0;»PU0,0;PD400,0;PU;",
  CR: "«CR0,1,0,1,0,1;»PC1,1,0,0;PU0,0;PD400,0;PU;",
  IN: "PR;«IN;»PU400,0;PD0,400;PU;",
  DF: "PR;«DF;»PU400,0;PD0,400;PU;",
  IP: "SC0,1,0,1;«IP0,0,400,800;»PU0,0;PD1,1;PU;",
  SC: "«SC0,1,0,1;»PU0,0;PD1,1;PU;",
  IR: "SC0,1,0,1;«IR25,25,50,75;»PU0,0;PD1,1;PU;",
  RO: "«RO90;»PU0,0;PD400,200;PU;",
  IW: "«IW0,0,200,200;»PU0,0;PD400,0;PU;",
  SM: "«SM*;»PU0,0;PD400,0;PU;",
  LB: `PU0,0;«LBA${ETX}»`,
  BL: `PU0,0;«BLA${ETX}»PB;`,
  PB: `PU0,0;BLA${ETX}«PB;»`,
  DT: `PU0,0;«DT#;»LBA#B${ETX}`,
  SI: `PU0,0;«SI1,2;»LBAB${ETX}`,
  SR: `PU0,0;«SR5,5;»LBAB${ETX}`,
  DI: `PU0,0;«DI0,1;»LBAB${ETX}`,
  DR: `PU0,0;«DR1,2;»LBAB${ETX}`,
  DV: `PU0,0;«DV1;»LBAB${ETX}`,
  SL: `PU0,0;«SL1;»LBAB${ETX}`,
  LO: `PU0,0;PD400,0;PU;«LO5;»LBAB${ETX}`,
  ES: `PU0,0;«ES1;»LBAB${ETX}`,
  CP: `PU0,0;PD400,0;PU;«CP5,1;»LBAB${ETX}`,
  UC: "PU0,0;«UC99,4,0,0,8;»",
  XT: "PU0,0;PD400,0;PU200,0;«XT;»",
  YT: "PU0,0;PD400,0;PU200,0;«YT;»",
  TL: "PU0,0;«TL50;»XT;",
  PG: "PU0,0;PD400,0;PU0,0;«PG;»PD0,400;PU;",
  AF: "PU0,0;PD400,0;PU0,0;«AF;»PD0,400;PU;",
  AH: "PU0,0;PD400,0;PU0,0;«AH;»PD0,400;PU;",
  FR: "PU0,0;PD400,0;PU0,0;«FR;»PD0,400;PU;",
};

/** All that a reader notices of a drawing. */
async function noticed(text: string): Promise<string> {
  const drawing = await hpgl(`IN;SP1;${text}`);
  const { widthMm, heightMm, groups, colors, dashes, paths, warnings } = drawing;
  const looks = [paths.stroke, paths.fill, paths.dash, paths.group].map((column) => [...column]);
  return JSON.stringify([
    [widthMm, heightMm],
    shapesOf(drawing),
    groups,
    colors,
    dashes,
    looks,
    warnings.map(({ message }) => message),
  ]);
}

describe("the table of HPGL commands", () => {
  /** HP 7475A, Interfacing and Programming Manual. */
  const HP7475A =
    "AA AR CA CI CP CS DC DF DI DP DR DT EA ER EW FT IM IN IP IW LB LT OA OC OD OE OF OH OI OO OP OS OW PA PD PR PS PT PU RA RO RR SA SC SI SL SM SP SR SS TL UC VS WG XT YT";
  /** PCL 5 Technical Reference and HP-GL/2 Reference Guide. */
  const HPGL2 =
    "AA AC AD AR AT BP BR BZ CF CI CO CP CR CT DF DI DL DR DT DV EA EC EP ER ES EW FI FN FP FR FT IN IP IR IW LA LB LM LO LT MC MG MT NP NR OD OE OH OI OP OS PA PC PD PE PG PM PP PR PS PU PW QL RA RF RO RP RR RT SA SB SC SD SI SL SM SP SR SS ST SV TD TR UL VS WG WU";
  const names = COMMAND_GROUPS.flatMap((group) => group.names);

  it("has each command of HP-GL and HP-GL/2 once", () => {
    expect([...HP7475A.split(" "), ...HPGL2.split(" ")].filter((name) => !names.includes(name))).toEqual([]);
    expect(names.filter((name, i) => names.indexOf(name) !== i)).toEqual([]);
  });

  it("is the one in the document", () => {
    const page = readFileSync(new URL("../../../../docs/import.md", import.meta.url), "utf8");
    const rows = [...page.matchAll(/^\| `([A-Z]{2}(?: [A-Z]{2})*)` +\| (\w+) +\| (.*?) +\|$/gm)].map((row) =>
      row.slice(1),
    );
    const OUTCOMES = { drawn: "drawn", alike: "alike", reported: "reported", setting: "nothing" };
    expect(rows).toEqual(
      COMMAND_GROUPS.map(({ names: all, outcome, about }) => [all.join(" "), OUTCOMES[outcome], about]),
    );
  });

  it.each(COMMAND_GROUPS.flatMap((group) => group.names.map((name) => [name, group] as const)))(
    "tells the truth about %s",
    async (name, { outcome, warning, reads }) => {
      const parameters = reads === "numbers" || reads === "encoded" ? "1,1,1,1,1,1" : `A${ETX}`;
      const reported = async (after: string): Promise<readonly string[]> =>
        codes(await hpgl(`IN;${LINE}${name}${parameters};${after}IN;SP1;PU0,0;PD90,90;LBb${ETX}`));
      const isOfText = warning === "text-style-ignored";
      // In a drawing without such letters, nothing is missing.
      if (isOfText) expect(await reported("")).toEqual([]);
      const warnings = await reported(isOfText ? `LBa${ETX}` : "");
      if (outcome === "reported") expect(warnings).toEqual([warning]);
      else expect(warnings).not.toContain("not-supported");
      if (outcome === "setting") expect(warnings).toEqual([]);
    },
  );

  it.each(
    COMMAND_GROUPS.filter(({ outcome }) => outcome === "drawn" || outcome === "alike").flatMap(
      ({ names: all }) => all,
    ),
  )("draws what %s asks for", async (name) => {
    const example = EXAMPLES[name] ?? "";
    expect(example).toContain(`«${name}`);
    expect(await noticed(example.replace(/[«»]/g, ""))).not.toBe(
      await noticed(example.replace(/«[^»]*»/, "")),
    );
  });
});
