/** Several drawings on one sheet: added, selected, moved, copied, aligned, kept, and plotted as one job. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { colorCounts, dropFile, openView } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

/** A line to the right and down, so that size, mirroring and turning are seen in its ends. */
const flag = (width: number, height: number, layer: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}">
  <g inkscape:groupmode="layer" id="ink" inkscape:label="${layer}"><path d="M0 0L${width} ${height}" fill="none" stroke="#000"/></g></svg>`;

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.open("sheet");
  await test.look("Ink");
  await test.panel("Drawing");
});
afterAll(async () => test.close());

const file = (name: string, text: string) => ({
  name: `${name}.svg`,
  mimeType: "image/svg+xml",
  buffer: Buffer.from(text),
});

async function add(...files: ReturnType<typeof file>[]): Promise<void> {
  const before = await pieceCount();
  await test.field("Add to the sheet").setInputFiles(files);
  await expect.poll(pieceCount).toBe(Math.max(before, 1) + files.length);
  await test.planned();
}

const pieces = () => test.page.getByRole("list", { name: "Drawings on the sheet" }).getByRole("checkbox");
const pieceCount = (): Promise<number> => pieces().count();
const button = (name: string) => test.page.getByRole("button", { name, exact: true });

async function press(name: string): Promise<void> {
  await button(name).click();
  await test.planned();
}

async function type(label: string, value: number): Promise<void> {
  await test.field(label).fill(String(value));
  await test.field(label).press("Enter");
  await test.planned();
}

/** The ends of the strokes that a job of this sheet would draw, in whole 1/100 mm, sorted. */
async function ends(): Promise<number[][]> {
  const { xy, offsets } = await test.strokesOf(await test.queue());
  const lines = Array.from({ length: offsets.length - 1 }, (_, i) => {
    const points = [...xy.subarray(2 * offsets[i], 2 * offsets[i + 1])];
    const [x0, y0] = points;
    const [x1, y1] = points.slice(-2);
    const line = [x0, y0, x1, y1].map((mm) => Math.round(mm * 100) / 100);
    return line[0] <= line[2] ? line : [line[2], line[3], line[0], line[1]];
  });
  return lines.sort((a, b) => a[1] - b[1] || a[0] - b[0]);
}

describe("several drawings on a sheet", () => {
  it("a second file is added beside the first one, with layers of its own", async () => {
    await test.drop("flag", flag(60, 40, "Ink"));
    const [alone] = await ends();
    expect(alone).toEqual([0, 0, 60, 40]);
    await add(file("leaf", flag(30, 20, "!Gold")));
    const [first, second] = await ends();
    expect(first).toEqual(alone);
    expect(second[2] - second[0]).toBeCloseTo(30, 1);
    expect(second[0]).toBeGreaterThanOrEqual(60);
    expect(await test.page.locator(".drawn-size strong").textContent()).toBe("flag + leaf");
    const job = (await test.jobs()).find(({ name }) => name === "flag + leaf")!;
    const { layers } = await test.strokesOf(job);
    expect(layers.map(({ name }) => name)).toEqual(["Ink (flag)", "!Gold (leaf)"]);
  });

  it("the added drawing is selected, and takes place, size and turn by numbers", async () => {
    await type("From the left", 100);
    await type("From the top", 50);
    await type("Width", 60);
    expect((await ends())[1]).toEqual([100, 50, 160, 90]);
    await type("Turn", 90);
    // About its middle, (130, 70).
    expect((await ends())[1]).toEqual([110, 100, 150, 40]);
    await type("Turn", 0);
    await type("Scale", 100);
    expect((await ends())[1]).toEqual([100, 50, 130, 70]);
  });

  it("is aligned to the paper, the margins and each other", async () => {
    await test.page.getByRole("radio", { name: "Paper", exact: true }).check();
    await press("Right");
    await press("Bottom");
    expect((await ends())[1]).toEqual([267, 190, 297, 210]);
    await test.page.getByRole("radio", { name: "Margins", exact: true }).check();
    await press("Left");
    await press("Middle");
    expect((await ends())[1]).toEqual([15, 95, 45, 115]);
    await press("Select all");
    await test.page.getByRole("radio", { name: "Each other", exact: true }).check();
    await press("Centre");
    expect(await ends()).toEqual([
      [0, 0, 60, 40],
      [15, 95, 45, 115],
    ]);
    await press("Top");
    expect((await ends()).map(([, y0]) => y0)).toEqual([0, 0]);
  });

  it("each step is undone and redone, and the first one leads back to the single drawing", async () => {
    const undo = button("Undo");
    const after = await ends();
    let steps = 0;
    while ((await pieceCount()) > 0) {
      await undo.click();
      steps++;
    }
    await test.planned();
    expect(await ends()).toEqual([[0, 0, 60, 40]]);
    for (let step = 0; step < steps; step++) await button("Redo").click();
    await test.planned();
    expect(await ends()).toEqual(after);
  });

  it("a drawing is selected by a press on the paper, and dragged millimetre for millimetre", async () => {
    await press("Select none");
    const { left, top, right } = await test.onScreen("paper");
    const scale = (right - left) / 297;
    const at = (xMm: number, yMm: number) => [left + xMm * scale, top + yMm * scale] as const;
    const { mouse, keyboard } = test.page;
    // The larger one, where the smaller one does not lie.
    await mouse.click(...at(5, 20));
    expect(await pieces().nth(0).isChecked()).toBe(true);
    await keyboard.down("Alt");
    await mouse.move(...at(5, 20));
    await mouse.down();
    await mouse.move(...at(60, 60), { steps: 4 });
    await mouse.move(...at(105, 120), { steps: 4 });
    await mouse.up();
    await keyboard.up("Alt");
    const moved = (await ends()).find(([x0, , x1]) => Math.round(x1 - x0) === 60)!;
    expect(Math.abs(moved[0] - 100)).toBeLessThan(0.4);
    expect(Math.abs(moved[1] - 100)).toBeLessThan(0.4);
    await test.page.locator(".stage").focus();
    await keyboard.press("ArrowRight");
    const nudged = (await ends()).find(([x0, , x1]) => Math.round(x1 - x0) === 60)!;
    expect(nudged[0]).toBeCloseTo(moved[0] + 1, 1);
  });

  it("the whole sheet is there again after a reload", async () => {
    const before = await ends();
    await test.page.waitForTimeout(600);
    await test.page.reload();
    await test.planned();
    await test.panel("Drawing");
    expect(await pieceCount()).toBe(2);
    expect(await ends()).toEqual(before);
  });

  it("is opened from its job with all drawings, to be changed further", async () => {
    const before = await ends();
    await test.drop("other", flag(10, 10, "Ink"));
    expect(await pieceCount()).toBe(0);
    // Nothing of the sheet falls on the next drawing.
    expect(await ends()).toEqual([[0, 0, 10, 10]]);
    await test.panel("Queue");
    const row = test.page.getByRole("button", { name: "More for flag + leaf" });
    await row.last().click();
    await test.page.getByRole("button", { name: "Open flag + leaf" }).click();
    await test.panel("Drawing");
    await expect.poll(pieceCount).toBe(2);
    await test.planned();
    expect(await ends()).toEqual(before);
  });

  it("copies fill the margins in a grid, and a second press makes it anew", async () => {
    await test.drop("card", flag(60, 40, "Ink"));
    await test.group("Drawing", "Copies in a grid");
    await type("Columns", 2);
    await type("Rows", 3);
    await type("Gap", 6);
    await press("Make 2 × 3 copies");
    expect(await pieceCount()).toBe(6);
    // 180 mm high with two gaps of 6 mm: cells of 56 mm, so copies of 84 × 56 mm in the middle of 267 mm.
    const left = 15 + (267 - 2 * 84 - 6) / 2;
    const cells = [0, 1, 2].flatMap((row) =>
      [0, 1].map((column) => [
        left + column * 90,
        15 + row * 62,
        left + column * 90 + 84,
        15 + row * 62 + 56,
      ]),
    );
    expect(await ends()).toEqual(cells);
    await type("Rows", 1);
    await press("Make 2 × 1 copies");
    expect(await pieceCount()).toBe(2);
    await press("Duplicate");
    expect(await pieceCount()).toBe(4);
    await press("Remove");
    expect(await pieceCount()).toBe(2);
  });

  it("a file dropped on the right half of the page is added, on the left half it replaces all", async () => {
    const dropAt = async (name: string, x: number): Promise<void> => {
      const transfer = await test.page.evaluateHandle(
        ([fileName, text]) => {
          const data = new DataTransfer();
          data.items.add(new File([text], fileName, { type: "image/svg+xml" }));
          return data;
        },
        [`${name}.svg`, flag(20, 20, "Ink")] as const,
      );
      await test.page.dispatchEvent("body", "dragenter", { dataTransfer: transfer, clientX: x });
      await test.page.getByText("Drop here to add it to the sheet").waitFor();
      await test.page.dispatchEvent("body", "drop", { dataTransfer: transfer, clientX: x });
    };
    const before = await pieceCount();
    await dropAt("stamp", 1200);
    await expect.poll(pieceCount).toBe(before + 1);
    await dropAt("alone", 100);
    await expect.poll(pieceCount).toBe(0);
    await test.planned();
    expect(await ends()).toEqual([[0, 0, 20, 20]]);
  });

  it("a file that can't be read is named and changes nothing", async () => {
    await test.field("Add to the sheet").setInputFiles([file("torn", "<svg><path")]);
    await test.page.getByText(/^torn can’t be drawn: /).waitFor();
    expect(await pieceCount()).toBe(0);
    await dropFile(test.page, "fine.svg", flag(20, 20, "Ink"));
    await test.planned();
    expect(test.complaints).toEqual([]);
  });
});

describe("a drawing over several sheets", () => {
  it("is shown as a whole with the edges of its sheets, and each sheet is a job of the queue", async () => {
    await test.drop("poster", flag(200, 100, "Ink"));
    await test.group("Paper", "Over several sheets");
    await type("Sheets across", 2);
    await type("Sheets down", 2);
    await type("Overlap of the sheets", 20);
    // Of A4 inside margins of 15 mm: 2 × 267 − 20 mm and 2 × 180 − 20 mm.
    await test.page.getByText("4 sheets, together 514 × 340\u202fmm.").waitFor();
    // Their numbers have plates of 20 × 20 px, so that they are read on dense ink too.
    await test.drawn();
    const counts = await colorCounts(test.page.getByRole("img", { name: "Preview", exact: true }));
    expect(counts.get(0x2f62d8) ?? 0).toBeGreaterThan(800);
    const known = new Set((await test.jobs()).map(({ id }) => id));
    await button("Add to queue").click();
    const fresh = async () => (await test.jobs()).filter(({ id }) => !known.has(id));
    await expect.poll(async () => (await fresh()).length).toBe(4);
    const jobs = await fresh();
    expect(jobs.map(({ name }) => name)).toEqual([1, 2, 3, 4].map((k) => `poster (sheet ${k} of 4)`));
    const pieces: number[][] = [];
    for (const job of jobs) {
      const { xy, offsets } = await test.strokesOf(job);
      const { tile } = job.settings.prepare;
      const [dx, dy] = [((tile - 1) % 2) * 247 - 15, Math.floor((tile - 1) / 2) * 160 - 15];
      let marks = 0;
      for (let i = 0; i + 1 < offsets.length; i++) {
        const [x0, y0, x1, y1] = xy.subarray(2 * offsets[i], 2 * offsets[i + 1]);
        if (x0 === x1 || y0 === y1) marks++;
        else pieces.push([x0 + dx, y0 + dy, x1 + dx, y1 + dy]);
      }
      expect(marks).toBe(4);
    }
    // The one line of the drawing fills the poster: 514 × 257 mm, in its middle. On two sheets it overlaps.
    const xs = pieces.flatMap(([x0, , x1]) => [x0, x1]);
    expect(Math.min(...xs)).toBeCloseTo(0, 1);
    expect(Math.max(...xs)).toBeCloseTo(514, 1);
    for (const [x0, y0, x1, y1] of pieces) {
      expect(y0).toBeCloseTo(41.5 + x0 / 2, 1);
      expect(y1).toBeCloseTo(41.5 + x1 / 2, 1);
    }
  });

  it("is plotted sheet by sheet, with a change of paper between them", async () => {
    const queued = (await test.jobs()).filter(({ name }) => name.startsWith("poster (sheet"));
    for (const { id } of queued) {
      await fetch(`${test.server.url}/api/v1/jobs/${id}/start`, {
        method: "POST",
        headers: { "x-plotwright": "1" },
      });
      await expect
        .poll(async () => (await test.jobs()).find((job) => job.id === id)?.state, { timeout: 60_000 })
        .toBe("done");
      const others = (await test.jobs()).filter(({ state }) => state === "plotting");
      expect(others).toEqual([]);
    }
  });

  it("shows a single sheet, and none of it falls on the next drawing", async () => {
    await openView(test.page, "Prepare");
    await test.group("Paper", "Over several sheets");
    await test.field("Sheets to plot").selectOption("Sheet 2 of 4");
    const job = await test.queue();
    expect([job.name, job.settings.prepare.tile]).toEqual(["poster", 2]);
    await test.drop("next", flag(20, 20, "Ink"));
    expect(await ends()).toEqual([[0, 0, 20, 20]]);
    expect(test.complaints).toEqual([]);
  });
});
