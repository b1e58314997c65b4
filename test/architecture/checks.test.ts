/** Each architecture check detects its fault: it is run on sources with the fault and without it. */
import { describe, expect, it } from "vitest";
import {
  cycleOfFiles,
  cycleOfFolders,
  EBB_COMMAND,
  foreignCommands,
  foreignKinds,
  privateIdentifiers,
  GRBL_COMMAND,
  importsBetweenDrivers,
  localTypesNamedLikeExported,
  plannedElsewhere,
  staticPluginImports,
  typesExportedTwice,
  type Sources,
} from "./checks.js";

interface Case {
  readonly name: string;
  readonly check: (sources: Sources) => string[];
  readonly bad: Sources;
  readonly found: readonly string[];
  /** Similar, but allowed. */
  readonly good: Sources;
}

const EBB_LINE = 'session.send("SP,1,100");';
const GRBL_LINE = "session.send(`G1X${x}`);";

const CASES: readonly Case[] = [
  {
    name: "an EBB command outside its driver",
    check: foreignCommands,
    bad: { "server/plotter/jog.ts": EBB_LINE },
    found: ['server/plotter/jog.ts: "SP,1,100"'],
    good: { "src/drivers/ebb/pen.ts": EBB_LINE, "web/app/help.tsx": "const key = <kbd>{'Esc'}</kbd>;" },
  },
  {
    name: "a Grbl command outside its driver, also in the other driver",
    check: foreignCommands,
    bad: { "web/plotter/jog.tsx": GRBL_LINE, "src/drivers/ebb/pen.ts": GRBL_LINE },
    found: ['web/plotter/jog.tsx: "G1X"', 'src/drivers/ebb/pen.ts: "G1X"'],
    good: { "src/drivers/grbl/job.ts": GRBL_LINE },
  },
  {
    name: "a kind of controller outside its folder",
    check: foreignKinds,
    bad: { "server/cli/plan.ts": 'if (machine.controller.kind === "ebb") plan();' },
    found: ['server/cli/plan.ts: "ebb"'],
    good: { "src/drivers/ebb/protocol/own.ts": 'const kind = "ebb";', "server/a.ts": 'const b = "webbing";' },
  },
  {
    name: "a driver that imports another one",
    check: importsBetweenDrivers,
    bad: { "src/drivers/grbl/job.ts": 'import { compile } from "../ebb/compile/compile.js";' },
    found: ["src/drivers/grbl/job.ts imports src/drivers/ebb/compile/compile"],
    good: { "src/drivers/grbl/job.ts": 'import { LineSplitter } from "../line-splitter.js";' },
  },
  {
    name: "a driver that imports a type of another one",
    check: importsBetweenDrivers,
    bad: { "src/drivers/grbl/deep/job.ts": 'import type { Leg } from "../../ebb/compile/leg.js";' },
    found: ["src/drivers/grbl/deep/job.ts imports src/drivers/ebb/compile/leg"],
    good: { "src/drivers/registry.ts": 'import * as ebb from "./ebb/controller.js";' },
  },
  {
    name: "a private member in the other form",
    check: privateIdentifiers,
    bad: {
      "src/plan/a.ts": "class A { #speed = 1; }",
      "web/a.tsx": "class A { #speed = <p />; show() { return this.#speed; } }",
    },
    found: ["src/plan/a.ts: #speed", "web/a.tsx: #speed", "web/a.tsx: #speed"],
    good: { "server/a.ts": 'class A { private speed = "#1"; constructor(private readonly b: number) {} }' },
  },
  {
    name: "types of one name that two files export",
    check: typesExportedTwice,
    bad: {
      "src/plan/a.ts": "export interface Place { x: number }",
      "web/b.ts": "export type Place = string;",
      "web/c.ts": "export abstract class Place {}",
    },
    found: ["Place: src/plan/a.ts, web/b.ts, web/c.ts"],
    good: {
      "src/plan/a.ts": "export interface Place { x: number }\nexport const Spot = 1;",
      "web/b.ts": 'export type { Place } from "../src/plan/a.js";\ntype Spot = string;',
    },
  },
  {
    name: "a local type with the name of an exported one, unless its meaning is obvious",
    check: (sources) => localTypesNamedLikeExported(sources, ["Point"]),
    bad: {
      "src/plan/a.ts": "export class Place {}",
      "web/b.ts": "interface Place { y: number }",
      "web/c.ts": "type Place = number;",
    },
    found: ["web/b.ts: Place", "web/c.ts: Place"],
    good: {
      "src/plan/a.ts": "export interface Point { x: number }",
      "web/b.ts": "type Point = readonly [number, number];\ninterface Row { y: number }",
      "web/c.ts": "interface Row { z: number }",
    },
  },
  {
    name: "a static import of a plug-in",
    check: staticPluginImports,
    bad: {
      "server/composition/load.ts": 'import { hooks } from "../plugins/webhooks/webhooks.js";',
      "server/plugins/watch-folder/watch.ts": 'export { hooks } from "../webhooks/webhooks.js";',
    },
    found: [
      "server/composition/load.ts imports server/plugins/webhooks/webhooks",
      "server/plugins/watch-folder/watch.ts imports server/plugins/webhooks/webhooks",
    ],
    good: {
      "server/composition/load.ts": 'const load = () => import("../plugins/webhooks/webhooks.js");',
      "server/plugins/webhooks/sender.ts": 'import { hooks } from "./webhooks.js";',
      "server/http/app.ts": 'import type { ServerPlugin } from "../plugins/server-plugin.js";',
    },
  },
  ...["src", "server", "web"].map((folder) => ({
    name: `a circle of files in ${folder}`,
    check: (sources: Sources) => cycleOfFiles(folder, sources),
    bad: {
      [`${folder}/a/one.ts`]: 'import { two } from "./two.js";',
      [`${folder}/a/two.ts`]: 'import type { Three } from "../b/three.js";',
      [`${folder}/b/three.ts`]: 'export { one } from "../a/one.js";',
    },
    found: [`${folder}/a/one`, `${folder}/a/two`, `${folder}/b/three`, `${folder}/a/one`],
    good: {
      [`${folder}/a/one.ts`]: 'import { two } from "./two.js";',
      [`${folder}/a/two.ts`]: 'import { three } from "../b/three.js";',
      [`${folder}/b/three.ts`]: 'import { z } from "zod";',
    },
  })),
  ...["src", "server"].map((folder) => ({
    name: `a circle of folders in ${folder}, although no files make one`,
    check: (sources: Sources) => cycleOfFolders(folder, sources),
    bad: {
      [`${folder}/a/one.ts`]: 'import { three } from "../b/deep/three.js";',
      [`${folder}/a/two.ts`]: "export const two = 2;",
      [`${folder}/b/deep/three.ts`]: "export const three = 3;",
      [`${folder}/b/deep/four.ts`]: 'import { two } from "../../a/two.js";',
    },
    found: [`${folder}/a`, `${folder}/b/deep`, `${folder}/a`],
    good: {
      [`${folder}/a/one.ts`]: 'import { three } from "../b/deep/three.js";',
      [`${folder}/a/two.ts`]: 'import { one } from "./one.js";',
      [`${folder}/b/deep/three.ts`]: "export const three = 3;",
    },
  })),
  {
    name: "planJob's parts, chained by the server, by the page and within src",
    check: plannedElsewhere,
    bad: {
      "server/cli/plan.ts": 'import {\n  compile,\n  plan as planned,\n} from "../../src/index.js";',
      "web/worker/plan.worker.ts": 'import { motionForFirmware } from "../../src/internal.js";',
      "src/export/commands.ts": 'import { plannerOf } from "../drivers/registry.js";',
      "src/job/again.ts": 'import { withLayerCodes } from "../plan/coded-layers.js";',
    },
    found: [
      "server/cli/plan.ts uses compile",
      "server/cli/plan.ts uses plan",
      "web/worker/plan.worker.ts uses motionForFirmware",
      "src/export/commands.ts uses plannerOf",
      "src/job/again.ts uses withLayerCodes",
    ],
    good: {
      "src/drivers/ebb/job.ts": 'import { plan } from "../../plan/plan.js";',
      "src/job/plan-job.ts": 'import { plannerOf } from "../drivers/registry.js";',
      "server/cli/plan.ts":
        'import { planJob } from "../../src/index.js";\nimport { plan } from "./plan.js";',
    },
  },
];

describe("a check of the architecture", () => {
  it.each(CASES)("finds $name", ({ check, bad, found, good }) => {
    expect(check(bad)).toEqual(found);
    expect(check(good)).toEqual([]);
  });

  it("tells a command from similar words", () => {
    const texts = ["EM,0,0", "SP,1,", "QS", "S2,", "plan", "S", "SVG", "Esc"];
    expect(texts.filter((text) => EBB_COMMAND.test(text))).toEqual(["EM,0,0", "SP,1,", "QS", "S2,"]);
    const commands = ["G1X", "G4P0", "G21G90", "M3S", "$X", "$SLP", "$I", "Grbl 1.1h", "M4"];
    const others = ["G", "Grbl's", "$5", "M10 30H90"];
    expect([...commands, ...others].filter((text) => GRBL_COMMAND.test(text))).toEqual(commands);
  });
});
