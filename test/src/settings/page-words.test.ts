/** Messages name settings by their flags. The page shows them with the names of its own controls. */
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { describe, expect, it } from "vitest";
import { importSvg, strokesOf } from "../../../src/index.js";
import { prepare } from "../../../src/prepare/prepare.js";
import { checkBounds, checkPaper } from "../../../src/prepare/on-paper.js";
import { inPageWords } from "../../../src/settings/page-words.js";
import { drawingOf } from "../../support/drawings/drawings.js";

const ROOT = path.join(import.meta.dirname, "..", "..", "..");

/** Lines of code with a flag in a text, besides the tables that define the flags. */
const linesWithFlags = (folder: string): string[] =>
  readdirSync(path.join(ROOT, folder), { recursive: true, encoding: "utf8" })
    .filter((file) => file.endsWith(".ts"))
    .flatMap((file) => readFileSync(path.join(ROOT, folder, file), "utf8").split("\n"))
    .filter((line) => /["'`].*--[a-z]/.test(line) && !/^\s*(\*|\/\*|\/\/|flag:)/.test(line));

const messageOf = (act: () => unknown): string => {
  try {
    act();
  } catch (error) {
    return (error as Error).message;
  }
  return "";
};

describe("the page's words", () => {
  it("name no flag in any message of the library, of the host, and of the serial ports", () => {
    const lines = ["src", "host", "server/serial"].flatMap(linesWithFlags);
    expect(lines.length).toBeGreaterThan(7);
    expect(lines.filter((line) => /--[a-z]/.test(inPageWords(line)))).toEqual([]);
  });

  it("name the settings as their controls are named, and leave out what is for other readers", async () => {
    const empty = prepare(drawingOf(["M0 0H10"]), { hatch: { spacingMm: 1, angleDeg: 0, cross: false } });
    expect(inPageWords(empty.warnings[0])).toBe(
      "There is nothing to fill with lines: no shape of this drawing is filled. Use “Fill closed outlines too”, or give shapes a fill.",
    );
    const edges = { leftMm: 0, topMm: 0, rightMm: 5, bottomMm: 0 };
    const outside = { strokeCount: 2, ...edges, canCut: true, canMove: true };
    const off = messageOf(() => checkPaper(outside, "refuse", { widthMm: 210, heightMm: 297 }, true));
    expect(off).toContain('with --outside, or "outside" in the settings: cut');
    expect(inPageWords(off)).toContain("Choose what happens to it with “What lies outside the paper”: cut");
    const far = strokesOf(
      [
        [
          [0, 0],
          [500, 0],
        ],
      ],
      { id: "a", name: "a", color: null },
    );
    const beyond = messageOf(() => checkBounds(far, { name: "V3", widthMm: 300, heightMm: 218 }));
    expect(beyond).toContain('with --machine, or "machine" in the settings.');
    expect(inPageWords(beyond)).toMatch(/choose its model with “Model”\.$/);
    const text = '<text x="9" y="9" fill="red">a</text>';
    const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="842" height="1191">${text}</svg>`;
    const words = (await importSvg(svg)).warnings.map(({ message }) => inPageWords(message)).join("\n");
    expect(words).toContain("convert text to paths in your drawing program.");
    expect(words).toContain("“Resolution of the file” 72 gives A3");
    expect(words).toContain("set “Resolution of the file” if it is wrong");
  });

  it("keep options that begin a server, and all other text", () => {
    const start = "This server has no shared queue. Start it with serve --shared-queue to use one.";
    expect(inPageWords(start)).toBe(start);
    expect(inPageWords("a -- b, or c. 5 - 3 --")).toBe("a -- b, or c. 5 - 3 --");
    expect(inPageWords("Use --machine. On the command line, run it. Then go on.")).toBe(
      "Use “Model”. Then go on.",
    );
  });
});
