/** What commands print of drawings, names and answers: plain text, in no more lines than the command's own. */
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import fc from "fast-check";
import { afterAll, beforeAll, describe, expect, it, vi } from "vitest";
import { printed } from "../../../server/cli/io.js";
import { LogBook, readLog } from "../../../server/storage/log-book.js";
import { PlotwrightError, machineById } from "../../../src/index.js";
import { printable, printableJson } from "../../../src/internal.js";
import { cli, cliWith, CaughtIo } from "../../support/processes/command-line.js";

/** Sets colours and the window's title by C0 and C1 characters, reverses the direction, and forges a line. */
const EVIL = "\u009b31m\u001b]0;title\u0007\u202ertl\u2066\u061c\u200f\r\nFAKE: all is well\u2028FAKE: too";
/** XML allows no other control characters. */
const EVIL_XML = EVIL.replace(/[\u001b\u0007]/g, "")
  .replaceAll("\n", "&#10;")
  .replaceAll("\r", "&#13;");
const CONTROLS = /[^\P{Cc}\n\t]|[\u061c\u200e\u200f\u2028\u2029\u202a-\u202e\u2066-\u2069]/u;

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="60mm" height="60mm" viewBox="0 0 60 60">
<g id="g${EVIL_XML}" inkscape:groupmode="layer" inkscape:label="!1 ${EVIL_XML}"><path d="M1 1h9" stroke="red" stroke-dasharray="x${EVIL_XML}"/>
<text font-family="F${EVIL_XML}" x="1" y="20">h\u4e00</text><image href="x${EVIL_XML}"/><path stroke="c${EVIL_XML}" d="M1 1h5q${EVIL_XML}"/>
<use href="#n${EVIL_XML}"/><path transform="t${EVIL_XML}" d="M2 2h9" stroke="blue"/><path clip-path="url(#c${EVIL_XML})" d="M2 4h9" stroke="blue"/></g>
<g id="g2" inkscape:groupmode="layer" inkscape:label="2 ${EVIL_XML}"><foox bar="${EVIL_XML}"/><path d="M10 1h9" stroke="green"/></g>
<style>@font-face{font-family:"${EVIL_XML}";src:url(x)} a:unk(x){} .x{stroke:${EVIL_XML}}</style></svg>`;
const DXF = `0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nB\u001b]0;title\u0007\n8\n0\n10\n0\n20\n0\n0\nLINE\n8\nL\u001b[2J\u009b\n10\n0\n20\n0\n11\n50\n21\n50\n0\nENDSEC\n0\nEOF\n`;

let dir: string;
let evil: string;
beforeAll(() => {
  dir = mkdtempSync(join(tmpdir(), "plotwright-printed-"));
  vi.stubEnv("XDG_DATA_HOME", dir);
  evil = join(dir, `a${EVIL.replaceAll("/", "")}.svg`);
  writeFileSync(evil, SVG);
  writeFileSync(join(dir, "a.svg"), SVG);
  writeFileSync(join(dir, "a.dxf"), DXF);
});
afterAll(() => {
  vi.unstubAllEnvs();
  rmSync(dir, { recursive: true, force: true });
});

function expectPlain(text: string): void {
  expect(text).not.toBe("");
  expect(CONTROLS.exec(text)?.[0]).toBeUndefined();
  expect(text.split("\n").filter((line) => line.startsWith("FAKE"))).toEqual([]);
}

describe("control characters and line ends", () => {
  it.each([
    ["of a drawing, in plan", ["plan", "a.svg"]],
    ["of a DXF, in plan", ["plan", "a.dxf"]],
    ["of a drawing, in the JSON of plan", ["plan", "a.svg", "--json"]],
    ["of layers, in the SVG of plan", ["plan", "a.svg", "--svg", "-"]],
    ["of layers, in the strokes of plan", ["plan", "a.svg", "--strokes", "-"]],
    ["of layers, in the preview of plan", ["plan", "a.svg", "--preview", "-"]],
    ["of a file's name, in plan", ["plan", "EVIL", "--only", "none"]],
    ["of a layer that is not there", ["plan", "a.svg", "--only", EVIL]],
    ["of a file that is not there", ["plan", `none${EVIL}`]],
    ["of a wrong option", ["plan", "a.svg", "--mode", EVIL]],
    ["of a wrong command", [`x${EVIL}`]],
    ["of a device that is not there", ["info", "--device", `/dev/${EVIL}`]],
    ["of a server that is not there", ["queue", "--url", `http://127.0.0.1:1/${EVIL}`]],
  ])("%s, are not printed", async (_, args) => {
    const { out, err } = await cli(
      ...args.map((arg) => (arg === "EVIL" ? evil : arg.startsWith("a.") ? join(dir, arg) : arg)),
    );
    expectPlain(out + err);
  });

  it("plot prints no control characters or line ends of layers and of the file's name", async () => {
    const io = new CaughtIo();
    const args = ["--device", "virtual", "--virtual-speed", "100", "--data", dir];
    const plotted = cliWith(io, "plot", evil, ...args);
    await expect.poll(() => io.errText).toMatch(/Put in the pen for/);
    io.line();
    await plotted;
    expectPlain(io.errText);
  });

  it("machines prints no control characters or line ends of a custom machine", async () => {
    const own = { ...machineById("axidraw-v3"), id: "own", name: "Own \u009b2J" };
    mkdirSync(join(dir, "machines"), { recursive: true });
    writeFileSync(join(dir, "machines", "own.json"), JSON.stringify(own));
    writeFileSync(join(dir, "machines", "b\u001b[2J.json"), "{");
    const { out, err } = await cli("machines", "--data", dir);
    expect(out + err).toMatch(/own/);
    expectPlain(out + err);
  });

  it("are not in the log either", async () => {
    const book = new LogBook(dir);
    book.write(`a ${EVIL}`);
    await book.written();
    const text = readLog(dir);
    expectPlain(text);
    expect(text.split("\n")).toHaveLength(2);
  });
});

describe("printed text", () => {
  it("has the lines of its template and no control characters, whatever its values are", () => {
    fc.assert(
      fc.property(fc.string({ unit: "binary" }), fc.string({ unit: "grapheme" }), (first, second) => {
        const text = printed`\n${first}\t: ${second}\nnext\n`;
        expect(CONTROLS.test(text)).toBe(false);
        expect(text.split("\n")).toHaveLength(4);
        expect(text.split("\t")).toHaveLength(2);
      }),
    );
  });

  it("is the same text if that is plain, also right to left", () => {
    for (const plain of ["Größe 3 µm", "مرحبا", "שלום", "花 🌸", "a  b"])
      expect(printable(plain)).toBe(plain);
  });

  it("JSON without control characters has the same meaning", () => {
    fc.assert(
      fc.property(fc.jsonValue(), fc.string({ unit: "binary" }), (value, text) => {
        const json = printableJson([value, text, EVIL]);
        expect(CONTROLS.test(json)).toBe(false);
        expect(JSON.parse(json)).toEqual(JSON.parse(JSON.stringify([value, text, EVIL])));
      }),
    );
  });

  it("an error is printed in one line", () => {
    const error = new PlotwrightError("bad-file", EVIL);
    expect(printed`plotwright: ${error.message}\n`.split("\n")).toHaveLength(2);
  });
});
