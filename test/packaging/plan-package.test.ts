/** plotwright-plan, the package for programs that only plan: packed, installed and used. */
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";

const MAX_MB = 10;
const folder = mkdtempSync(path.join(tmpdir(), "plotwright-plan-test-"));
const app = path.join(folder, "app");
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40"><style>path { stroke: red }</style><text x="5" y="30">plan</text><path fill="none" d="M5 5H50"/></svg>`;

function succeed(command: string, args: readonly string[], cwd: string): string {
  const shell = command === "npm" && process.platform === "win32";
  const { status, stdout, stderr } = spawnSync(command, args, { cwd, encoding: "utf8", shell });
  expect(`${status} ${status === 0 ? "" : stderr + stdout}`).toBe("0 ");
  return stdout.trim();
}

function runProgram(code: string): string {
  writeFileSync(path.join(app, "program.js"), code);
  return succeed(process.execPath, ["program.js"], app);
}

beforeAll(() => {
  mkdirSync(app);
  writeFileSync(path.join(app, "package.json"), '{ "name": "app", "private": true, "type": "module" }\n');
  succeed(process.execPath, ["scripts/pack-plan.mjs", folder], ROOT);
  const [packed] = readdirSync(folder).filter((name) => name.endsWith(".tgz"));
  const flags = ["--ignore-scripts", "--prefer-offline", "--no-audit", "--no-fund"];
  succeed("npm", ["install", ...flags, path.join(folder, packed)], app);
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

describe("plotwright-plan", () => {
  const modules = path.join(app, "node_modules");

  it(`takes at most ${MAX_MB} MB with all that it needs, and nothing of server, fonts and schemas`, () => {
    const files = readdirSync(modules, { recursive: true, encoding: "utf8" })
      .map((name) => statSync(path.join(modules, name)))
      .filter((file) => file.isFile());
    const mb = files.reduce((sum, { size }) => sum + size, 0) / 1e6;
    expect(mb).toBeGreaterThan(1);
    expect(mb).toBeLessThan(MAX_MB);
    for (const name of ["express", "serialport", "zod", "fontkit", "plotwright"]) {
      expect([name, existsSync(path.join(modules, name))]).toEqual([name, false]);
    }
    expect(existsSync(path.join(modules, "plotwright-plan", "LICENSE"))).toBe(true);
  });

  it("plans an SVG with styles and text as plotwright does", () => {
    const program = (name: string): string => `
      import { planSvg, trajectoryStats } from "${name}";
      const { trajectory, lines } = await planSvg(${JSON.stringify(SVG)});
      const { durationS, penLiftCount } = trajectoryStats(trajectory);
      console.log(durationS.toFixed(6), penLiftCount, lines().length);
    `;
    const whole = path.join(ROOT, "dist", "src", "index.js").replaceAll("\\", "/");
    const [durationS, lifts] = runProgram(program("plotwright-plan")).split(" ").map(Number);
    expect(durationS).toBeGreaterThan(4);
    expect(lifts).toBeGreaterThan(3);
    expect(runProgram(program("plotwright-plan"))).toBe(runProgram(program(`file://${whole}`)));
  });

  it("reads DXF, HPGL and JSON too", () => {
    const drawings = {
      "a.dxf": "0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n0\n20\n0\n11\n50\n21\n9\n0\nENDSEC\n0\nEOF\n",
      "a.hpgl": "IN;SP1;PU0,0;PD4000,0;PU;",
      "a.json": JSON.stringify({ widthMm: 60, heightMm: 40, layers: [{ strokes: [[5, 5, 50, 5]] }] }),
    };
    const program = `
      import { importDrawing, prepare } from "plotwright-plan";
      for (const [name, text] of Object.entries(${JSON.stringify(drawings)})) {
        const { strokes } = prepare(await importDrawing(name, text), {});
        console.log(name, strokes.offsets.length - 1);
      }`;
    expect(runProgram(program).split("\n")).toEqual(["a.dxf 1", "a.hpgl 1", "a.json 1"]);
  });

  it("names the package that a font file needs", () => {
    const program = `
      import { openOutlineFont } from "plotwright-plan";
      await openOutlineFont(new Uint8Array(4)).catch((error) => console.log(error.code, error.message));`;
    expect(runProgram(program)).toBe(
      "bad-setting A font file needs the package fontkit: npm install fontkit.",
    );
  });

  it("has types that need no other package", () => {
    writeFileSync(
      path.join(app, "typed.ts"),
      `import { planSvg, type Trajectory } from "plotwright-plan";
       export const planned = async (svg: string): Promise<Trajectory> =>
         (await planSvg(svg, { prepare: { marginMm: 5 } })).trajectory;\n`,
    );
    const options = ["--noEmit", "--strict", "--module", "nodenext", "--target", "es2022", "--types", ""];
    const compiler = path.join(ROOT, "node_modules", "typescript", "bin", "tsc");
    succeed(process.execPath, [compiler, ...options, "typed.ts"], app);
  });
});
