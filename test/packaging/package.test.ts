/** What a user gets from the registry: the packed tarball, installed in an empty folder. */
import { spawnSync } from "node:child_process";
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  readdirSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";

const folder = mkdtempSync(path.join(tmpdir(), "plotwright-package-"));
const app = path.join(folder, "app");
/** Without the user's own data folder, which may belong to a running server. */
const env = { ...process.env, XDG_DATA_HOME: folder };

function run(
  command: string,
  args: readonly string[],
  cwd: string,
): { status: number | null; stdout: string; stderr: string } {
  const isNpm = command === "npm" || command === "npx";
  return spawnSync(command, args, {
    cwd,
    env,
    encoding: "utf8",
    shell: isNpm && process.platform === "win32",
  });
}

function succeed(command: string, args: readonly string[], cwd: string): string {
  const result = run(command, args, cwd);
  expect(`${result.status} ${result.status === 0 ? "" : result.stderr}`.trim()).toBe("0");
  return result.stdout;
}

beforeAll(() => {
  mkdirSync(app);
  writeFileSync(path.join(app, "package.json"), '{ "name": "app", "private": true, "type": "module" }\n');
  // dist/ is fresh already (global set-up), so the build of `prepack` need not run again.
  succeed("npm", ["pack", "--ignore-scripts", "--pack-destination", folder], ROOT);
  const tarball = readdirSync(folder).find((name) => name.endsWith(".tgz")) ?? "";
  const flags = ["--ignore-scripts", "--prefer-offline", "--no-audit", "--no-fund"];
  succeed("npm", ["install", ...flags, path.join(folder, tarball)], app);
});

afterAll(() => rmSync(folder, { recursive: true, force: true }));

describe("the installed package", () => {
  const installed = path.join(app, "node_modules", "plotwright");

  it("has the built product and nothing else", () => {
    expect(readdirSync(installed).sort()).toEqual(
      [
        ...["ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE", "README.md", "SECURITY.md"],
        ...["dist", "docs", "inkscape", "package.json", "samples"],
      ].sort(),
    );
    expect(readdirSync(path.join(installed, "dist")).sort()).toEqual([
      "chunks",
      "host",
      "server",
      "src",
      "web",
    ]);
    expect(existsSync(path.join(installed, "dist", "web", "index.html"))).toBe(true);
  });

  it("has the licence of everything that is built into the page", () => {
    const text = readFileSync(path.join(installed, "dist", "web", "licences.txt"), "utf8");
    // Preact and zustand are in the page, css-tree, saxes and clipper2-ts in its workers, the fonts in our sources.
    for (const name of [
      "plotwright",
      "preact",
      "zustand",
      "css-tree",
      "saxes",
      "clipper2-ts",
      "Hershey fonts",
    ]) {
      const section = text
        .split("\n\n\n")
        .find((one) => one.startsWith(`${name} `) || one.startsWith(`${name},`));
      expect([name, section]).toEqual([name, expect.stringMatching(/permi(t|ssion)/i)]);
    }
  });

  it("has the licence of every package that is built into the library and the server", () => {
    const text = readFileSync(path.join(installed, "dist", "chunks", "licences.txt"), "utf8");
    const code = readdirSync(path.join(installed, "dist", "chunks"))
      .filter((name) => name.endsWith(".js"))
      .map((name) => readFileSync(path.join(installed, "dist", "chunks", name), "utf8"))
      .join("\n");
    const packages = new Set(
      [...code.matchAll(/^\/\/ node_modules\/((?:@[^/]+\/)?[^/]+)\//gm)].map(([, name]) => name),
    );
    expect([...packages]).toEqual(expect.arrayContaining(["culori", "css-tree", "domutils"]));
    for (const name of packages) {
      const section = text.split("\n\n\n").find((one) => one.startsWith(`${name} `));
      expect([name, section]).toEqual([name, expect.stringMatching(/permi(t|ssion)/i)]);
    }
  });

  it("has every file that its README links to", () => {
    const readme = readFileSync(path.join(installed, "README.md"), "utf8");
    const links = [...readme.matchAll(/\]\(([^)#]+)[^)]*\)/g)].map((match) => match[1] ?? "");
    const own = links.filter((link) => !/^https?:/.test(link));
    expect(own.length).toBeGreaterThan(5);
    expect(own.filter((link) => !existsSync(path.join(installed, link)))).toEqual([]);
  });

  it("has one PlotwrightError class for all its entries", () => {
    const program = `
      import { PlotwrightError, importSvg } from "plotwright";
      import { createServer } from "plotwright/server";
      import { requestBoard } from "plotwright/web-serial";
      const errors = [];
      try { await importSvg("no drawing"); } catch (error) { errors.push(error); }
      await createServer({ dataDir: "package.json" }).catch((error) => errors.push(error));
      await requestBoard().catch((error) => errors.push(error));
      console.log(errors.map((error) => error instanceof PlotwrightError).join(" "));
    `;
    writeFileSync(path.join(app, "errors.js"), program);
    expect(succeed(process.execPath, ["errors.js"], app).trim()).toBe("true true true");
  });

  it("prints its version by npx plotwright --version", () => {
    const { version } = JSON.parse(readFileSync(path.join(ROOT, "package.json"), "utf8")) as {
      version: string;
    };
    expect(succeed("npx", ["--no-install", "plotwright", "--version"], app).trim()).toBe(version);
  });

  it("plans one of its samples by npx plotwright plan --json", () => {
    const sample = path.join(installed, "samples", "hello-paper.svg");
    const report = JSON.parse(
      succeed("npx", ["--no-install", "plotwright", "plan", sample, "--json"], app),
    ) as {
      strokes: number;
      durationS: number;
    };
    expect(report.strokes).toBeGreaterThan(20);
    expect(report.durationS).toBeGreaterThan(10);
  });

  it("answers npx plotwright info about the virtual board", () => {
    expect(succeed("npx", ["--no-install", "plotwright", "info", "--device", "virtual"], app)).toMatch(
      /EBB|firmware/i,
    );
  });

  it.each([
    ["plotwright", "plan, importSvg, prepare, compile, VirtualBoard"],
    ["plotwright/plotter", "openPlotter"],
    ["plotwright/schema", "plotSettingsSchema, jobSchema"],
    ["plotwright/server", "createServer"],
    ["plotwright/web-serial", "requestBoard, openWebSerial, browserClock"],
  ])("lets a program import from %s", (entry, names) => {
    const program = `import { ${names} } from "${entry}"; console.log([${names}].every((name) => name !== undefined));`;
    writeFileSync(path.join(app, "program.js"), program);
    expect(succeed(process.execPath, ["program.js"], app).trim()).toBe("true");
  });
});
