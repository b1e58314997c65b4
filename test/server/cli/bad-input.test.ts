/** Files and arguments that are not what a command takes: one line that explains it, and an exit code. */
import { existsSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { beforeEach, describe, expect, it } from "vitest";
import { cli } from "../../support/processes/command-line.js";
import { folderOfTest } from "../../support/processes/folders.js";

let dir: string;
beforeEach(() => {
  dir = folderOfTest();
});

describe("bad input on the command line", () => {
  const write = (name: string, text: string): string => {
    const path = join(dir, name);
    writeFileSync(path, text);
    return path;
  };
  const svg = (content: string, attributes = 'width="100mm" height="100mm" viewBox="0 0 100 100"'): string =>
    `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" ${attributes} fill="none" stroke="black">${content}</svg>`;

  it("exits with 3 and one line that explains the fault, for files that can't be plotted", async () => {
    const files: Record<string, string> = {
      absent: join(dir, "absent.svg"),
      folder: dir,
      "not an SVG": write("a.svg", "hello"),
      "another XML": write("b.svg", "<html><body/></html>"),
      empty: write("c.svg", ""),
      binary: write("d.svg", "\0\x01\x02\xff".repeat(1000)),
      truncated: write("e.svg", svg("<path d='M0 0h10'/>").slice(0, -20)),
      "without lines": write("f.svg", svg("")),
      "larger than the machine": write(
        "h.svg",
        svg('<path d="M0 0L900 900"/>', 'width="900mm" height="900mm" viewBox="0 0 900 900"'),
      ),
    };
    for (const [what, file] of Object.entries(files)) {
      const extra =
        what === "larger than the machine" ? ["--no-fit", "--paper", "1000x1000", "--margin", "0"] : [];
      const { code, out, err } = await cli("plan", file, "--json", ...extra);
      expect([what, code, out]).toEqual([what, 3, ""]);
      expect([what, err.trimEnd().split("\n").length, err]).toEqual([
        what,
        1,
        expect.stringMatching(/^plotwright: .{15,}/),
      ]);
    }
  });

  it("never expands entities, so an entity bomb stays a short text", async () => {
    const entities = [..."bcdefghij"]
      .map((name, i) => `<!ENTITY ${name} "${`&${"abcdefghij"[i]};`.repeat(10)}">`)
      .join("");
    const bomb = `<!DOCTYPE svg [<!ENTITY a "aaaaaaaaaa">${entities}]>${svg('<text x="10" y="20">&j;</text><path d="M10 30h50"/>')}`;
    const { code, out, err } = await cli("plan", write("bomb.svg", bomb), "--json");
    expect([0, 3]).toContain(code);
    if (code === 0) expect((JSON.parse(out) as { strokes: number }).strokes).toBeLessThan(100);
    else expect(err).toMatch(/^plotwright: .{15,}/);
  });

  it("plots the rest if only parts of a file are broken, without NaN in it", async () => {
    const files = {
      "NaN coordinates": svg('<path d="M NaN NaN L 10 10"/><path d="M10 10h50"/>'),
      "huge coordinates": svg('<path d="M0 0L1e300 1e300"/><path d="M10 10h50"/>'),
      "circular use": svg('<g id="a"><path d="M10 10h50"/><use xlink:href="#a"/></g>'),
      "one point": svg('<path d="M20 20z"/><path d="M10 10h50"/>'),
    };
    for (const [what, text] of Object.entries(files)) {
      const { code, out, err } = await cli("plan", write("part.svg", text), "--json");
      expect([what, code, err]).toEqual([what, 0, ""]);
      const report = JSON.parse(out) as Record<string, unknown>;
      expect([what, report["drawMm"]]).toEqual([what, expect.any(Number)]);
      // NaN is null in JSON. Only a layer's pen may be.
      expect([what, /(?<!"pen":)null/.test(out)]).toEqual([what, false]);
    }
  });

  it("takes 100 000 nested groups and a 50 MB file, or explains why not", async () => {
    const nested = svg(`${"<g>".repeat(100_000)}<path d="M10 10h50"/>${"</g>".repeat(100_000)}`);
    const large = svg(`<path d="M10 10h50"/><!--${"x".repeat(50_000_000)}-->`);
    for (const text of [nested, large]) {
      const { code, err } = await cli("plan", write("large.svg", text), "--json");
      expect([0, 3]).toContain(code);
      expect(err).not.toMatch(/internal/);
      expect(code === 0 ? err === "" : err.length > 20).toBe(true);
    }
  });

  it("exits with 2 for unknown usage, and writes nothing", async () => {
    const file = write("good.svg", svg('<path d="M10 10h50"/>'));
    const out = join(dir, "out.txt");
    for (const args of [
      ["plan", file, "--commands", out, "--unknown"],
      ["plan", file, "--commands", out, "--speed", "fast"],
      ["plan", file, "--commands", out, "--machine", "typewriter"],
      ["plan", file, "--commands", out, "--firmware", "latest"],
      ["plan"],
      ["plan", file, file],
      ["fly"],
      ["pen", "sideways"],
      ["--port", "http"],
      ["serve", "--port", "70000"],
    ]) {
      const { code, out: printed, err } = await cli(...args);
      expect([args, code, printed]).toEqual([args, 2, ""]);
      expect([args, err]).toEqual([args, expect.stringMatching(/^plotwright: .+\n$/)]);
    }
    expect(existsSync(out)).toBe(false);
  });

  it("prints help and version on request, with 0", async () => {
    expect(await cli("--version")).toEqual({ code: 0, out: "0.0.0\n", err: "" });
    const help = await cli("plan", "--help");
    expect(help.code).toBe(0);
    expect(help.out).toMatch(/--preview/);
  });
});
