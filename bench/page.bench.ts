/**
 * The work of the page's own thread with large drawings, in real Chromium. Measured are the longest task
 * while a file of 25 MB is opened and planned, and while it is queued; the time from the plan of a million
 * segments to its picture; and the work per frame while it is panned and zoomed. How many frames per second
 * result depends on the graphics card and the machine. Needs the built product (`npm run build`).
 */
import type { Page } from "playwright-core";
import { PageTest } from "../test/support/browser/page-test.js";
import { rendererName } from "./pen.bench.js";
import type { Report, Row } from "./run.js";

const FILES = [
  { what: "100 000 segments in 1 000 strokes", strokes: 1_000, points: 101 },
  { what: "25 MB, 40 000 polylines", strokes: 40_000, points: 43 },
  { what: "1 000 000 segments in 1 000 strokes", strokes: 1_000, points: 1_001 },
] as const;
const FRAMES = 60;

/** Recorded by the page for this benchmark. */
interface Watched {
  /** Tasks over 50 ms, which is what a browser reports. */
  longestTaskMs: number;
  /** Cost of panning and zooming. */
  movedMs: number;
  file: File | null;
}

export default async function pageBench(report: Report): Promise<void> {
  const rows: Row[] = [];
  let renderer = "";
  for (const { what, strokes, points } of FILES) {
    const test = await PageTest.open("bench");
    try {
      renderer = await test.page.evaluate(rendererName);
      rows.push({ what, ...(await measure(test, strokes, points)) });
    } finally {
      await test.close();
    }
  }
  report(
    "The page and large drawings",
    rows,
    `In Chromium, ${renderer}; tasks and work are those of the page's thread, tasks under 50 ms do not count.`,
  );
}

async function measure(test: PageTest, strokes: number, points: number): Promise<Row> {
  const { page } = test;
  // The compiler of this script wraps named functions in a helper that the page does not have.
  await page.evaluate("window.__name = (named) => named");
  await page.evaluate(watch);
  const bytes = await page.evaluate(makeFile, { strokes, points });
  await page.evaluate(forget);
  const openedAt = await page.evaluate(open);
  const moments = await page.evaluate(picturesAfter, openedAt);
  const opening = await page.evaluate(watched);
  await page.evaluate(forget);
  const mean = await moveAbout(page);
  const moving = await page.evaluate(watched);
  await page.evaluate(forget);
  await test.queue();
  const queueing = await page.evaluate(watched);
  return {
    MB: Number((bytes / 1e6).toFixed(1)),
    "opened to planned s": Number(((moments.plannedMs - openedAt) / 1_000).toFixed(1)),
    "longest task ms": Math.round(opening.longestTaskMs),
    "longest while queued ms": Math.round(queueing.longestTaskMs),
    "planned to first picture ms": Math.round(moments.pictureMs - moments.plannedMs),
    "to whole picture ms": Math.round(moments.wholeMs - moments.plannedMs),
    "work of a frame ms": Number(mean.toFixed(1)),
    "longest in a frame ms": Math.round(moving.longestTaskMs),
    "frames a second": Math.round((1_000 * FRAMES) / moving.movedMs),
  };
}

/**
 * Pans and zooms by the wheel, one step per frame; returns the processor time of the page's thread per frame,
 * ms.
 */
async function moveAbout(page: Page): Promise<number> {
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const workS = async (): Promise<number> => {
    const { metrics } = await session.send("Performance.getMetrics");
    return metrics.find(({ name }) => name === "TaskDuration")!.value;
  };
  const before = await workS();
  await page.evaluate(turnWheel, FRAMES);
  return ((await workS()) - before) * (1_000 / FRAMES);
}

// The following code runs in the page.

function watch(): void {
  const watched: Watched = { longestTaskMs: 0, movedMs: 0, file: null };
  (window as unknown as { watched: Watched }).watched = watched;
  new PerformanceObserver((list) => {
    for (const { duration } of list.getEntries())
      watched.longestTaskMs = Math.max(watched.longestTaskMs, duration);
  }).observe({ type: "longtask" });
}

/** A scribble of that many strokes. Writes the file in parts, because one text of it would be a long task. */
async function makeFile({ strokes, points }: { strokes: number; points: number }): Promise<number> {
  const parts = [
    '<svg xmlns="http://www.w3.org/2000/svg" width="210mm" height="297mm" viewBox="0 0 210 297">',
  ];
  parts.push('<g fill="none" stroke="#000">\n');
  let seed = 7;
  const next = (): number => (seed = (seed * 16_807) % 2_147_483_647) / 2_147_483_647;
  for (let s = 0; s < strokes; s++) {
    let x = 10 + 190 * next();
    let y = 10 + 270 * next();
    let angle = 6.3 * next();
    let d = `M${x.toFixed(3)} ${y.toFixed(3)}`;
    for (let k = 1; k < points; k++) {
      angle += 0.6 * (next() - 0.5);
      if (x < 6 || x > 204 || y < 6 || y > 291) angle = Math.atan2(148 - y, 105 - x);
      x += 0.4 * Math.cos(angle);
      y += 0.4 * Math.sin(angle);
      d += `L${x.toFixed(3)} ${y.toFixed(3)}`;
    }
    parts.push(`<path d="${d}"/>\n`);
    if (s % 500 === 0) await new Promise((resolve) => setTimeout(resolve, 0));
  }
  parts.push("</g></svg>");
  const file = new File(parts, "scribble.svg", { type: "image/svg+xml" });
  (window as unknown as { watched: Watched }).watched.file = file;
  return file.size;
}

async function forget(): Promise<void> {
  await new Promise((resolve) => setTimeout(resolve, 1_000));
  const { watched } = window as unknown as { watched: Watched };
  watched.longestTaskMs = 0;
  performance.clearMarks();
}

/** Drops the file on the page; returns the time on the page's clock. */
function open(): number {
  const { file } = (window as unknown as { watched: Watched }).watched;
  const data = new DataTransfer();
  data.items.add(file!);
  const openedAt = performance.now();
  for (const type of ["dragenter", "dragover", "drop"]) {
    document.body.dispatchEvent(new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
  }
  return openedAt;
}

/** With the control key the wheel zooms, with shift it pans. */
async function turnWheel(frames: number): Promise<void> {
  const stage = document.querySelector(".preview .stage")!;
  const { left, top, width, height } = stage.getBoundingClientRect();
  const place = { clientX: left + width / 2, clientY: top + height / 2, bubbles: true, cancelable: true };
  const fromMs = performance.now();
  for (let i = 0; i < frames; i++) {
    const deltaY = i % 20 < 10 ? -30 : 30;
    stage.dispatchEvent(
      new WheelEvent("wheel", { ...place, deltaY, ctrlKey: i % 2 === 0, shiftKey: i % 2 === 1 }),
    );
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }
  (window as unknown as { watched: Watched }).watched.movedMs = performance.now() - fromMs;
}

/** When the plan of the opened file came, when the preview first showed it, and when it was complete. */
async function picturesAfter(
  openedAt: number,
): Promise<{ plannedMs: number; pictureMs: number; wholeMs: number }> {
  const markAfter = async (name: string, fromMs: number): Promise<number> => {
    for (;;) {
      const mark = performance.getEntriesByName(name).find(({ startTime }) => startTime >= fromMs);
      if (mark) return mark.startTime;
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  };
  const plannedMs = await markAfter("plotwright-planned", openedAt);
  const pictureMs = await markAfter("plotwright-picture", plannedMs);
  return { plannedMs, pictureMs, wholeMs: await markAfter("plotwright-whole-picture", plannedMs) };
}

/** Times recorded so far; long tasks are reported slightly later. */
async function watched(): Promise<{ longestTaskMs: number; movedMs: number }> {
  await new Promise((resolve) => setTimeout(resolve, 1_000));
  const { longestTaskMs, movedMs } = (window as unknown as { watched: Watched }).watched;
  return { longestTaskMs, movedMs };
}
