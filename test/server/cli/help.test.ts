/** The help of commands, and what the shell completes: both made from the settings tables and the program's options. */
import { spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it, onTestFinished } from "vitest";
import type { Command } from "commander";
import { COMMANDS } from "../../../server/cli/commands.js";
import { buildProgram } from "../../../server/cli/program.js";
import { SETTING_OPTIONS } from "../../../server/cli/setting-table.js";
import { MACHINES } from "../../../src/index.js";
import { SETTING_FLAGS } from "../../../src/internal.js";
import { CaughtIo, cli } from "../../support/processes/command-line.js";
import { folderOfTest } from "../../support/processes/folders.js";

const NAMES = COMMANDS.map(({ name }) => name);
const program = (): Promise<Command> =>
  buildProgram(NAMES, { io: new CaughtIo(), version: "1", setExitCode: () => undefined });

/** The flags under each heading, in order. */
function groupsOf(help: string): Record<string, string[]> {
  const groups: Record<string, string[]> = {};
  let heading = "";
  for (const line of help.split("\n")) {
    const found = /^([A-Z]\w*):/.exec(line)?.[1];
    if (found !== undefined) heading = found;
    const flag = /^ {2}(?:-h, )?(--[\w-]+)/.exec(line)?.[1];
    if (flag !== undefined) (groups[heading] ??= []).push(flag);
  }
  return groups;
}

const DECISIONS = ["Machine", "Paper", "Drawing", "Lines", "Motion", "Pen"];
const flagOf = ({ flags }: { readonly flags: string }): string => flags.split(" ")[0];

describe("the help of a command", () => {
  it.each(["plan", "plot", "add"])("of %s is grouped by decision, common options first", async (name) => {
    const common = groupsOf((await cli(name, "--help")).out);
    const all = groupsOf((await cli(name, "--help-all")).out);
    for (const groups of [common, all]) {
      expect(Object.keys(groups).slice(0, 6)).toEqual(DECISIONS);
      expect(Object.keys(groups).slice(6)).toEqual(["Options"]);
    }
    expect(Object.values(all).flat()).toEqual(expect.arrayContaining(SETTING_OPTIONS.map(flagOf)));
    for (const option of SETTING_OPTIONS) {
      const heading = DECISIONS.find((one) => one.toLowerCase() === option.group) ?? "";
      expect(all[heading]).toContain(flagOf(option));
      expect([flagOf(option), common[heading].includes(flagOf(option))]).toEqual([
        flagOf(option),
        option.isCommon,
      ]);
      // The common ones are the first of their group.
      const first = all[heading].filter((flag) => common[heading].includes(flag));
      expect(all[heading].slice(0, first.length)).toEqual(first);
    }
  });

  it("says how many more options there are, and shows no more than a screen of settings", async () => {
    const { out } = await cli("plan", "--help");
    const more = /\n(\d+) more options: plotwright plan --help-all\n/.exec(out)?.[1];
    const rare = SETTING_OPTIONS.filter(({ isCommon }) => !isCommon).length;
    expect(Number(more)).toBe(rare);
    expect(SETTING_OPTIONS.length - rare).toBeLessThan(25);
    expect((await cli("plan", "--help-all")).out).not.toContain("more options");
    expect((await cli("queue", "--help")).out).not.toContain("more options");
    expect((await cli("help", "plan")).out).toBe(out);
    expect((await cli("settings", "save", "--help")).out).toContain("plotwright settings save --help-all");
  });

  it("puts each setting of the tables into one group", () => {
    for (const { path, group } of SETTING_FLAGS) {
      const top = path.split(".")[0];
      expect(DECISIONS.map((one) => one.toLowerCase())).toContain(group);
      if (top === "pen" || top === "motion") expect([path, group]).toEqual([path, top]);
    }
  });
});

// Windows has no bash of its own.
describe.runIf(process.platform !== "win32")("completion in bash", () => {
  const script = async (): Promise<string> => {
    const file = join(folderOfTest(), "completion.bash");
    writeFileSync(file, (await cli("completion", "bash")).out);
    return file;
  };
  /** What bash would offer, for each line; the last word of a line is the one that is being typed. */
  const offered = (file: string, lines: readonly (readonly string[])[]): string[][] => {
    const quote = (words: readonly string[]): string => words.map((word) => `'${word}'`).join(" ");
    const tries = lines.map(
      (words) =>
        `COMP_WORDS=(${quote(words)}); COMP_CWORD=${words.length - 1}; _plotwright; echo "\${COMPREPLY[*]}"`,
    );
    const input = [`source '${file}'`, "compopt() { :; }", ...tries].join("\n");
    const { stdout, stderr, status } = spawnSync("bash", ["--norc", "--noprofile"], {
      input,
      encoding: "utf8",
    });
    expect([status, stderr]).toEqual([0, ""]);
    return stdout
      .replace(/\n$/, "")
      .split("\n")
      .map((line) => line.split(" ").filter((word) => word !== ""));
  };

  it("offers commands, their options, and the values of options", async () => {
    const file = await script();
    const [commands, all, order, machine, paper, subs, shells, pen, number] = offered(file, [
      ["plotwright", "pl"],
      ["plotwright", "plan", "a.svg", "--pen-"],
      ["plotwright", "plan", "--order", ""],
      ["plotwright", "plot", "a.svg", "--machine", "next"],
      ["plotwright", "add", "--paper", "A"],
      ["plotwright", "settings", ""],
      ["plotwright", "completion", ""],
      ["plotwright", "pen", ""],
      ["plotwright", "plan", "--speed", ""],
    ]);
    expect(commands).toEqual(["plan", "plot"]);
    expect(all).toEqual(expect.arrayContaining(["--pen-up", "--pen-down", "--pen-overlap", "--pen-error"]));
    expect(order).toEqual(["none", "fast", "best"]);
    expect(machine).toEqual(MACHINES.map(({ id }) => id).filter((id) => id.startsWith("next")));
    expect(paper).toEqual(["A1", "A2", "A3", "A4", "A5", "A6"]);
    expect(subs).toEqual(["show", "set", "unset", "save", "presets", "remove"]);
    expect(shells).toEqual(["bash", "zsh", "fish"]);
    expect(pen).toEqual(["up", "down"]);
    expect(number).toEqual([]);
  });

  it("offers every option of every command, and the choices of each", async () => {
    const { commands } = await program();
    const file = await script();
    const options = commands.flatMap((command) => command.options.map((option) => ({ command, option })));
    expect(options.length).toBeGreaterThan(400);
    const lines = options.map(({ command, option }) => ["plotwright", command.name(), option.long ?? ""]);
    offered(file, lines).forEach((found, i) =>
      expect([lines[i], found.includes(lines[i][2])]).toEqual([lines[i], true]),
    );
    const choices = options.filter(({ option }) => option.argChoices !== undefined);
    const values = offered(
      file,
      choices.map(({ command, option }) => ["plotwright", command.name(), option.long ?? "", ""]),
    );
    expect(values).toEqual(choices.map(({ option }) => option.argChoices));
  });

  it("completes what is typed at a terminal", { timeout: 60_000 }, async () => {
    const { spawn } = await import("@lydell/node-pty");
    const folder = folderOfTest();
    writeFileSync(join(folder, "drawing.svg"), "");
    const shell = spawn("bash", ["--norc", "--noprofile", "-i"], { cwd: folder, cols: 200 });
    onTestFinished(() => shell.kill());
    let text = "";
    shell.onData((data) => (text += String(data)));
    const shown = (words: string): Promise<void> =>
      expect.poll(() => text, { timeout: 45_000 }).toContain(words);
    // Before its prompt, bash does not read the tabs itself.
    shell.write(`source '${await script()}'; PS1='rea''dy: '\r`);
    await shown("ready: ");
    shell.write("plotwright pla\tdraw\t--mir\tup\t");
    await shown("plotwright plan drawing.svg --mirror upDown ");
  });
});

describe("completion in zsh and fish", () => {
  it("names every command and option, with quoted descriptions", async () => {
    const { commands } = await program();
    const [zsh, fish] = [(await cli("completion", "zsh")).out, (await cli("completion", "fish")).out];
    for (const command of commands.filter((one) => one.name() !== "help")) {
      expect(zsh).toContain(`'${command.name()}:`);
      expect(fish).toContain(`-a ${command.name()} -d '`);
      for (const { long } of command.options) {
        expect(zsh).toContain(`'*${long}[`);
        expect(fish).toContain(`__fish_seen_subcommand_from ${command.name()}' -l ${long?.slice(2)} `);
      }
    }
    // Each line of fish is one command with closed quotes; sh has the same single quotes.
    for (const text of [
      fish.replaceAll("complete -c", ": -c"),
      zsh.replace(/^[^]*commands=\(/, "a() {\n: ").replace(/\n {2}\)\n[^]*$/, "\n}\n"),
    ]) {
      if (process.platform === "win32") break;
      const { status, stderr } = spawnSync("sh", ["-n"], { input: text, encoding: "utf8" });
      expect([status, stderr]).toEqual([0, ""]);
    }
    expect((await cli("completion", "tcsh")).code).toBe(2);
  });
});
