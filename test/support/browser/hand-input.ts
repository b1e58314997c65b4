/** A hand that draws on the page: its pointer, and what the page must make of its way. */
import type { CDPSession, Page } from "playwright-core";
import type { Line } from "../../../src/index.js";
import { machineById } from "../../../src/index.js";
import { orientedPaper } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { mmFromScreen, screenPoint, type View } from "../../../web/scene/view.js";
import { PaperEdge } from "../../../web/watch/hand-drawing/paper-edge.js";
import { SmoothStroke } from "../../../web/watch/hand-drawing/smooth-stroke.js";

/** As the page starts. */
const SMOOTHING = 0.4;
/** Between two events of the pointer. */
const STEP_MS = 12;

type Sample = readonly [type: string, xPx: number, yPx: number, atMs: number];

interface Recorded {
  pointerSamples?: Sample[];
}

/** Moves a pointer of the page to px of its window. */
export interface Pointer {
  down(x: number, y: number): Promise<void>;
  move(x: number, y: number): Promise<void>;
  up(): Promise<void>;
}

export const mouseOf = ({ mouse }: Page): Pointer => ({
  down: async (x, y) => {
    await mouse.move(x, y);
    await mouse.down();
  },
  move: (x, y) => mouse.move(x, y),
  up: () => mouse.up(),
});

export const fingerOf = (session: CDPSession): Pointer => {
  const send = (type: "touchStart" | "touchMove" | "touchEnd", points: { x: number; y: number }[]) =>
    session.send("Input.dispatchTouchEvent", { type, touchPoints: points }).then(() => undefined);
  return {
    down: (x, y) => send("touchStart", [{ x, y }]),
    move: (x, y) => send("touchMove", [{ x, y }]),
    up: () => send("touchEnd", []),
  };
};

/** The sheet that is drawn on. */
export class DrawnSheet {
  private constructor(
    private readonly page: Page,
    private readonly pointer: Pointer,
  ) {}

  /** Opens drawing by hand in Watch. */
  static async open(page: Page, pointer: Pointer): Promise<DrawnSheet> {
    await page
      .getByRole("region", { name: "Plot under way" })
      .getByRole("button", { name: "Draw", exact: true })
      .click();
    await page.getByText("Draw here").waitFor();
    await page.locator("canvas[data-view]").waitFor({ state: "attached" });
    const sheet = new DrawnSheet(page, pointer);
    await page.evaluate(() => {
      const recorded = window as unknown as Recorded;
      const samples: Sample[] = (recorded.pointerSamples = []);
      const stage = document.querySelector<HTMLElement>('.watch[data-mode="draw"] .stage')!;
      for (const type of ["pointerdown", "pointermove", "pointerup"]) {
        stage.addEventListener(
          type,
          (event) => {
            const pointerEvent = event as PointerEvent;
            const { left, top } = stage.getBoundingClientRect();
            const all = type === "pointermove" ? pointerEvent.getCoalescedEvents() : [pointerEvent];
            for (const one of all) samples.push([type, one.clientX - left, one.clientY - top, one.timeStamp]);
          },
          { capture: true },
        );
      }
    });
    return sheet;
  }

  private async view(): Promise<{ readonly view: View; readonly left: number; readonly top: number }> {
    const { text, left, top } = await this.page.evaluate(() => {
      const stage = document.querySelector<HTMLElement>('.watch[data-mode="draw"] .stage')!;
      const box = stage.getBoundingClientRect();
      const canvas = stage.querySelector<HTMLElement>("canvas[data-view]")!;
      return { text: canvas.dataset["view"]!, left: box.left, top: box.top };
    });
    const [scale, offsetX, offsetY, turn] = text.split(" ").map(Number);
    return { view: { scale, offsetX, offsetY, turn }, left, top };
  }

  /** Draws a stroke along `at` for so many seconds, mm. */
  async stroke(at: (s: number) => readonly [xMm: number, yMm: number], forS: number): Promise<void> {
    const { view, left, top } = await this.view();
    const onScreen = (s: number): [number, number] => {
      const [x, y] = screenPoint(view, ...at(s));
      return [x + left, y + top];
    };
    const beginMs = performance.now();
    await this.pointer.down(...onScreen(0));
    for (let s = 0; s < forS; s = (performance.now() - beginMs) / 1_000) {
      await this.pointer.move(...onScreen(s));
      await this.page.waitForTimeout(STEP_MS);
    }
    await this.pointer.up();
  }

  /** The smoothed strokes that the page must have made of all that the pointer did since it was opened. */
  async expected(): Promise<Line[]> {
    const samples = await this.page.evaluate(() => (window as unknown as Recorded).pointerSamples!);
    const { view } = await this.view();
    const { paper, landscape } = DEFAULT_PLOT_SETTINGS.prepare;
    const { widthMm, heightMm } = orientedPaper(paper, landscape);
    const machine = machineById("axidraw-v3");
    const reach = {
      x0: 0,
      y0: 0,
      x1: Math.min(widthMm, machine.widthMm),
      y1: Math.min(heightMm, machine.heightMm),
    };
    const lines: [number, number][][] = [];
    let isDown = false;
    let stroke: { smooth: SmoothStroke; edge: PaperEdge } | null = null;
    const edgeOf = (): PaperEdge =>
      new PaperEdge(reach, {
        lineTo: (x, y) => {
          if (!isDown) lines.push([]);
          isDown = true;
          lines[lines.length - 1].push([x, y]);
        },
        penUp: () => {
          isDown = false;
        },
      });
    for (const [type, x, y, atMs] of samples) {
      if (type === "pointerdown") {
        const edge = edgeOf();
        stroke = { edge, smooth: new SmoothStroke(SMOOTHING, view.scale, (...to) => edge.lineTo(...to)) };
      }
      if (type !== "pointerup") stroke?.smooth.add(...mmFromScreen(view, x, y), atMs);
      else if (stroke) {
        stroke.smooth.finish();
        stroke.edge.penUp();
        stroke = null;
      }
    }
    return lines;
  }
}
