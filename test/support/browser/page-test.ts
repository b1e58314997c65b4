/** One browser, one server and one page for a browser test, with its helpers. */
import type { Browser, BrowserContextOptions, Locator, Page } from "playwright-core";
import { importDrawing, prepare, type StrokeSet } from "../../../src/index.js";
import { prepareSettingsOf } from "../../../src/internal.js";
import { jobSchema, snapshotSchema, type Job } from "../../../src/schema/index.js";
import { launchBrowser, PLAIN } from "./browser.js";
import {
  chooseSample,
  dropFile,
  nextFrames,
  openGroup,
  openPanel,
  plotBar,
  waitForPicture,
  waitForPlan,
} from "./page-actions.js";
import { temporaryFolder } from "../processes/folders.js";
import { startServerProcess, type ServerProcess } from "../processes/server-process.js";

const DESKTOP: BrowserContextOptions = {
  ...PLAIN,
  viewport: { width: 1440, height: 900 },
  colorScheme: "light",
};

/** CSS px of the page. */
interface ScreenBox {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

type DropFirst<T extends readonly unknown[]> = T extends readonly [unknown, ...infer Rest] ? Rest : never;

export class PageTest {
  /** Messages of the browser's console. */
  readonly complaints: string[] = [];

  private constructor(
    readonly browser: Browser,
    readonly server: ServerProcess,
    readonly page: Page,
    private readonly removeData: () => void,
  ) {
    page.on("pageerror", (error) => this.complaints.push(error.message));
    page.on("console", (message) => {
      if (message.type() === "error") this.complaints.push(message.text());
    });
  }

  /** Starts with a sample on the paper. `args`: for the server. */
  static async open(...options: Parameters<typeof PageTest.firstVisit>): Promise<PageTest> {
    const test = await PageTest.firstVisit(...options);
    await chooseSample(test.page);
    return test;
  }

  /** Starts with an empty paper. */
  static async firstVisit(
    name: string,
    options: BrowserContextOptions = {},
    args: readonly string[] = [],
  ): Promise<PageTest> {
    const data = temporaryFolder(name);
    const browser = await launchBrowser();
    const server = await startServerProcess({ dataDir: data.path, virtualSpeed: 50, args });
    const context = await browser.newContext({ ...DESKTOP, ...options });
    const test = new PageTest(browser, server, await context.newPage(), data.remove);
    await test.page.goto(server.url);
    return test;
  }

  async close(): Promise<void> {
    await this.browser.close();
    await this.server.stop();
    this.removeData();
  }

  /** Drops a drawing and waits for its plan. */
  async drop(name: string, svg: string): Promise<void> {
    await dropFile(this.page, `${name}.svg`, svg);
    await this.page.getByText(name, { exact: true }).first().waitFor({ state: "attached" });
    await this.planned();
  }

  /** Waits until the last change has been planned. */
  async planned(): Promise<void> {
    await nextFrames(this.page);
    await waitForPlan(this.page);
  }

  /** Waits until it is visible, too. */
  async drawn(): Promise<void> {
    await this.planned();
    await waitForPicture(this.page);
  }

  async panel(...[name]: DropFirst<Parameters<typeof openPanel>>): Promise<void> {
    await openPanel(this.page, name);
  }

  /** Opens or closes a group of settings. */
  async group(...of: DropFirst<Parameters<typeof openGroup>>): Promise<void> {
    await openGroup(this.page, ...of);
  }

  /** Selects a view of the drawing. */
  async look(name: "Speed" | "Ink" | "Time" | "Layer" | "Order" | "Pen" | "Pen (simulated)"): Promise<void> {
    const looks = this.page.getByRole("group", { name: "Colour by" });
    await looks.getByRole("radio", { name, exact: true }).check();
  }

  /** The bounding box, in CSS px of the page, of the canvas pixels of that brightness: "paper" or "ink". */
  async onScreen(what: "paper" | "ink"): Promise<ScreenBox> {
    // Off the paper, so that no tooltip for a stroke appears.
    await this.page.mouse.move(700, 20);
    await this.drawn();
    const canvas = this.page.getByRole("img", { name: "Preview", exact: true });
    const at = (await canvas.boundingBox())!;
    // Without the notices over its upper edge, which are as dark as ink.
    await this.page
      .locator(".notice-close")
      .evaluateAll((buttons) => buttons.forEach((button) => (button as HTMLElement).click()));
    await this.page.locator(".notice").first().waitFor({ state: "detached" });
    const png = (await canvas.screenshot()).toString("base64");
    const found = await this.page.evaluate(
      async ([base64, isPaper]) => {
        const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d")!;
        context.drawImage(bitmap, 0, 0);
        const { data, width } = context.getImageData(0, 0, bitmap.width, bitmap.height);
        const box = { left: Infinity, top: Infinity, right: -Infinity, bottom: -Infinity };
        for (let i = 0; i < data.length; i += 4) {
          const x = (i / 4) % width;
          const y = Math.floor(i / 4 / width);
          // Rulers, the drawing's name and the legend are at the edges.
          if (x < 26 || y < 48 || y > bitmap.height - 30) continue;
          const isIt = isPaper
            ? Math.min(data[i], data[i + 1], data[i + 2]) > 249
            : Math.max(data[i], data[i + 1], data[i + 2]) < 90;
          if (!isIt) continue;
          box.left = Math.min(box.left, x);
          box.top = Math.min(box.top, y);
          box.right = Math.max(box.right, x + 1);
          box.bottom = Math.max(box.bottom, y + 1);
        }
        return box;
      },
      [png, what === "paper"] as const,
    );
    return {
      left: found.left + at.x,
      top: found.top + at.y,
      right: found.right + at.x,
      bottom: found.bottom + at.y,
    };
  }

  async jobs(): Promise<readonly Job[]> {
    const answer = await fetch(`${this.server.url}/api/v1/state`);
    return snapshotSchema.parse(await answer.json()).jobs;
  }

  /** The job once the server has planned it. */
  async measured({ id }: Job): Promise<Job> {
    for (;;) {
      const job = jobSchema.parse(await (await fetch(`${this.server.url}/api/v1/jobs/${id}`)).json());
      if (job.stats !== null) return job;
      await this.page.waitForTimeout(50);
    }
  }

  /** Adds the drawing to the queue, and returns the job as the server has it. */
  async queue(): Promise<Job> {
    await this.planned();
    const known = new Set((await this.jobs()).map(({ id }) => id));
    await plotBar(this.page).getByRole("button", { name: "Add to queue" }).click();
    for (;;) {
      const fresh = (await this.jobs()).find((job) => !known.has(job.id));
      if (fresh) return fresh;
      await this.page.waitForTimeout(50);
    }
  }

  /** The strokes that a job would draw, from its own file and settings. */
  async strokesOf(job: Job): Promise<StrokeSet> {
    const text = await (await fetch(`${this.server.url}/api/v1/jobs/${job.id}/drawing`)).text();
    return prepare(await importDrawing("", text), prepareSettingsOf(job.settings)).strokes;
  }

  /** The box that a drawing queued now would cover, mm. */
  async queuedBox(): Promise<{ x0: number; y0: number; x1: number; y1: number }> {
    const { xy } = await this.strokesOf(await this.queue());
    const xs = [...xy].filter((_, k) => k % 2 === 0);
    const ys = [...xy].filter((_, k) => k % 2 === 1);
    return { x0: Math.min(...xs), y0: Math.min(...ys), x1: Math.max(...xs), y1: Math.max(...ys) };
  }

  field(label: string): Locator {
    return this.page.getByLabel(label, { exact: true });
  }
}
