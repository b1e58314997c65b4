/** The workflows of .github: what they run exists, their permissions are minimal, their actions are pinned. */
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { afterAll, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";

const FOLDER = path.join(ROOT, ".github", "workflows");
const WORKFLOWS = readdirSync(FOLDER).map((name) => ({
  name,
  text: readFileSync(path.join(FOLDER, name), "utf8").replace(/^\s*#.*$/gm, ""),
}));
const manifest = JSON.parse(readFileSync(path.join(ROOT, "package.json"), "utf8")) as {
  version: string;
  engines: { node: string };
  scripts: Record<string, string>;
};

/** The values of all lines `key: value`, in steps too. */
const valuesOf = (text: string, key: string): string[] =>
  [...text.matchAll(new RegExp(`^\\s*(?:- )?${key}: (.+)$`, "gm"))].map((match) => match[1].trim());

describe.each(WORKFLOWS)("the workflow $name", ({ text }) => {
  it("runs only npm scripts and files that exist", () => {
    const commands = valuesOf(text, "run");
    expect(commands.length).toBeGreaterThan(0);
    for (const command of commands) {
      const script = /^npm (?:run ([\w:-]+)|(test))/.exec(command);
      if (script)
        expect([command, manifest.scripts[script[1] ?? script[2]]]).toEqual([command, expect.any(String)]);
      const file = /^node (\S+)/.exec(command)?.[1];
      if (file !== undefined) expect([command, existsSync(path.join(ROOT, file))]).toEqual([command, true]);
    }
  });

  it("uses actions that are pinned by their hash, with the version beside it", () => {
    const actions = valuesOf(text, "uses");
    expect(actions.length).toBeGreaterThan(0);
    expect(
      actions.filter((action) => !/^actions\/[\w-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+$/.test(action)),
    ).toEqual([]);
  });

  it("may only read by default, ends by itself, and never runs twice at once", () => {
    expect(text).toMatch(/^permissions:\n {2}contents: read\n\S/m);
    expect(text).toMatch(/^concurrency:\n {2}group: /m);
    const jobCount = valuesOf(text, "runs-on").length;
    expect(valuesOf(text, "timeout-minutes")).toHaveLength(jobCount);
    expect(text).not.toMatch(/write-all|contents: write/);
  });
});

describe("the workflows", () => {
  it("test the oldest supported Node and newer ones, on three systems", () => {
    const { text } = WORKFLOWS.find(({ name }) => name === "test.yml")!;
    expect(valuesOf(text, "node")).toEqual(["[20, 22, 24]"]);
    expect(manifest.engines.node).toMatch(/^>=20\./);
    expect(valuesOf(text, "os")).toEqual(["[ubuntu-latest, macos-latest, windows-latest]"]);
  });

  it("check a release before they publish it with its origin", () => {
    const { text } = WORKFLOWS.find(({ name }) => name === "release.yml")!;
    const commands = valuesOf(text, "run");
    expect(commands.indexOf("node scripts/check-release.mjs")).toBeGreaterThan(-1);
    expect(commands.at(-1)).toMatch(/^npm publish .*--provenance/);
    // Only the last job may publish, and it runs none of the project's code, nor install scripts.
    const [before, publish] = text.split(/^ {2}publish:$/m);
    expect(before).not.toMatch(/id-token|environment:/);
    expect(publish).toMatch(/permissions:\n {6}id-token: write\n {4}\w/);
    expect(valuesOf(publish, "run").every((command) => command.includes("--ignore-scripts"))).toBe(true);
    expect(valuesOf(publish, "uses").some((action) => action.includes("checkout"))).toBe(false);
  });
});

describe("the container image", () => {
  const read = (name: string): string => readFileSync(path.join(ROOT, name), "utf8");
  const dockerfile = read("Dockerfile");

  it("is made from files that the repository has, with the Node versions that are tested", () => {
    const copied = [...dockerfile.matchAll(/^COPY (?!--from)(.+) \S+$/gm)].flatMap(([, names]) =>
      names.split(" "),
    );
    expect(copied).toEqual(["package.json", "package-lock.json", "."]);
    const bases = [...dockerfile.matchAll(/^FROM node:(\d+)-/gm)].map(([, version]) => Number(version));
    expect(bases).toHaveLength(2);
    expect(new Set(bases).size).toBe(1);
    expect([20, 22, 24]).toContain(bases[0]);
    for (const name of ["dist", "node_modules", ".git"])
      expect(read(".dockerignore").split("\n")).toContain(name);
  });

  it("runs the server without root's rights, with its data in a volume, and has time to lift the pen", () => {
    expect(dockerfile).toMatch(/^USER node$/m);
    expect(dockerfile.indexOf("USER node")).toBeLessThan(dockerfile.indexOf("ENTRYPOINT"));
    expect(dockerfile).toMatch(/^VOLUME \/data$/m);
    expect(dockerfile).toMatch(/^ENV .*XDG_DATA_HOME=\/data/m);
    expect(dockerfile).toMatch(/^ENTRYPOINT \["plotwright"\]\nCMD \["serve", "--lan"\]$/m);
    expect(read("compose.yaml")).toMatch(/stop_grace_period: 60s/);
    expect(read("compose.yaml")).not.toMatch(/privileged/);
    expect(read("docs/docker.md")).toMatch(/--stop-timeout 60/);
  });
});

describe("the check of a release", () => {
  const folder = mkdtempSync(path.join(tmpdir(), "plotwright-release-"));
  afterAll(() => rmSync(folder, { recursive: true, force: true }));

  /** What it says about a package with these fields, in a workflow started by this tag. */
  function check(fields: Record<string, string>, tag = "v1.2.3"): string {
    writeFileSync(path.join(folder, "package.json"), JSON.stringify({ version: "1.2.3", ...fields }));
    writeFileSync(path.join(folder, "CHANGELOG.md"), "# Changelog\n\n## 1.2.3\n");
    const script = path.join(ROOT, "scripts", "check-release.mjs");
    const env = { ...process.env, GITHUB_REF_TYPE: "tag", GITHUB_REF_NAME: tag };
    return spawnSync(process.execPath, [script, folder], { env, encoding: "utf8" }).stderr.trim();
  }
  const filledIn = { author: "a", repository: "r", homepage: "h", bugs: "b" };

  it("passes a package that has everything", () => {
    expect(check(filledIn)).toBe("");
  });

  it("names what the publisher has not filled in", () => {
    expect(check({ author: "a", bugs: "b" })).toContain("package.json lacks repository, homepage");
  });

  it("refuses a version without a section in the changelog", () => {
    expect(check({ ...filledIn, version: "1.3.0" }, "v1.3.0")).toContain('no section "## 1.3.0"');
  });

  it("refuses a tag that is not the version", () => {
    expect(check(filledIn, "v1.2.4")).toContain("the tag v1.2.4 is not the version");
  });
});
