import { describe, expect, it } from "vitest";
import { Painter, type PainterClock } from "../../../web/scene/painter.js";
import type { Detail, Frame, Picture, SceneRenderer } from "../../../web/scene/renderer.js";
import { makeFrame } from "../../support/jobs/jobs-on-page.js";

const COARSE = 40_000;
const sceneOf = (count: number): Picture => ({
  draw: { count, bytes: new ArrayBuffer(0) },
  travel: { count: 0, bytes: new ArrayBuffer(0) },
  totalS: 1,
});

class TurnClock implements PainterClock {
  /** Called at each turn, for the page's work in between. */
  onTurn: (turn: number) => void = () => undefined;
  private turns = 0;
  private ms = 0;

  nowMs(): number {
    return this.ms;
  }
  async wait(ms: number): Promise<void> {
    this.ms += Math.max(1, ms);
    this.onTurn(++this.turns);
    return Promise.resolve();
  }
}

/** A card that draws that many pieces per millisecond of the clock, and records what it drew. */
class Card implements SceneRenderer {
  readonly parts: number[] = [];
  readonly shown: { offsetX: number; detail: Detail; pieces: number }[] = [];
  mostPartsAtOnce = 0;
  private busyUntilMs = 0;
  private atOnce = 0;
  private scene: Picture | null = null;
  private left = 0;
  private now: { frame: Frame; detail: Detail; pieces: number } | null = null;

  constructor(
    readonly piecesPerMs: number,
    readonly clock = new TurnClock(),
  ) {}

  setScene(scene: Picture | null): void {
    this.scene = scene;
    this.left = 0;
  }
  begin(wanted: Frame, detail: Detail): number {
    const count = this.scene?.draw.count ?? 0;
    this.left = detail === "whole" ? count : Math.min(count, COARSE);
    this.now = { frame: wanted, detail, pieces: 0 };
    return this.left;
  }
  advance(pieceCount: number): number {
    const drawn = Math.min(pieceCount, this.left);
    this.left -= drawn;
    this.parts.push(drawn);
    this.now!.pieces += drawn;
    this.atOnce = this.isIdle() ? 1 : this.atOnce + 1;
    this.mostPartsAtOnce = Math.max(this.mostPartsAtOnce, this.atOnce);
    this.busyUntilMs = Math.max(this.clock.nowMs(), this.busyUntilMs) + drawn / this.piecesPerMs;
    return drawn;
  }
  get isFinished(): boolean {
    return this.left === 0;
  }
  isIdle(): boolean {
    return this.clock.nowMs() >= this.busyUntilMs;
  }
  present(): void {
    const { frame: of, detail, pieces } = this.now!;
    this.shown.push({ offsetX: of.view.offsetX, detail, pieces });
  }
  close(): void {
    this.scene = null;
  }
}

const start = (card: Card, count: number) => {
  const pictures: [number, boolean][] = [];
  const painter = new Painter(card.clock, ({ view }, isWhole) => pictures.push([view.offsetX, isWhole]));
  painter.setRenderer(card);
  painter.setScene(sceneOf(count));
  return { painter, pictures };
};
/** Runs all pending work to its end. */
const settle = async (): Promise<void> => {
  for (let i = 0; i < 200_000; i++) await Promise.resolve();
};

describe("the painter", () => {
  it("draws a small drawing completely and at once", async () => {
    const card = new Card(50);
    const { painter, pictures } = start(card, 2_000);
    painter.show(makeFrame(1));
    await settle();
    expect(card.shown).toEqual([{ offsetX: 1, detail: "whole", pieces: 2_000 }]);
    expect(pictures).toEqual([[1, true]]);
  });

  it("shows a large drawing coarse first, and then all of it", async () => {
    const card = new Card(300);
    const { painter, pictures } = start(card, 1_000_000);
    painter.show(makeFrame(1));
    await settle();
    expect(card.shown).toEqual([
      { offsetX: 1, detail: "coarse", pieces: 40_000 },
      { offsetX: 1, detail: "whole", pieces: 1_000_000 },
    ]);
    expect(pictures).toEqual([
      [1, false],
      [1, true],
    ]);
  });

  it("soon draws everything at once on a fast card", async () => {
    const card = new Card(200_000);
    const { painter } = start(card, 1_000_000);
    painter.show(makeFrame(1));
    await settle();
    card.shown.length = card.parts.length = 0;
    painter.show(makeFrame(2));
    await settle();
    expect(card.shown).toEqual([{ offsetX: 2, detail: "whole", pieces: 1_000_000 }]);
    expect(card.parts).toEqual([1_000_000]);
  });

  it("keeps the parts short on a slow card, and sends one at a time", async () => {
    const card = new Card(20);
    const { painter } = start(card, 100_000);
    painter.show(makeFrame(1));
    await settle();
    expect(card.shown.at(-1)).toMatchObject({ detail: "whole", pieces: 100_000 });
    // The first part was a guess; after a few of them none takes longer than 50 ms.
    expect(Math.max(...card.parts.slice(4))).toBeLessThanOrEqual(1_000);
    expect(card.mostPartsAtOnce).toBe(1);
  });

  it("always shows something while the view moves, and everything when it stops", async () => {
    const card = new Card(100);
    const { painter } = start(card, 1_000_000);
    card.clock.onTurn = (turn) => {
      if (turn <= 3_000) painter.show(makeFrame(turn));
    };
    painter.show(makeFrame(0));
    await settle();
    const moving = card.shown.filter(({ offsetX }) => offsetX < 3_000);
    expect(moving.length).toBeGreaterThan(4);
    expect(moving.every(({ detail }) => detail === "coarse")).toBe(true);
    expect(card.shown.at(-1)).toEqual({ offsetX: 3_000, detail: "whole", pieces: 1_000_000 });
  });

  it("never shows the unfinished picture of one drawing as another's", async () => {
    const card = new Card(100);
    const { painter } = start(card, 1_000_000);
    card.clock.onTurn = (turn) => {
      if (turn !== 3) return;
      painter.setScene(sceneOf(500));
      painter.show(makeFrame(2));
    };
    painter.show(makeFrame(1));
    await settle();
    expect(card.shown).toEqual([{ offsetX: 2, detail: "whole", pieces: 500 }]);
  });

  it("draws the last frame again when the card was lost and is back", async () => {
    const card = new Card(100);
    const { painter, pictures } = start(card, 100_000);
    card.clock.onTurn = (turn) => {
      if (turn === 3) painter.setRenderer(null);
    };
    painter.show(makeFrame(1));
    await settle();
    expect(pictures).toEqual([]);
    painter.show(makeFrame(2));
    await settle();
    expect(pictures).toEqual([]);
    const other = new Card(100, card.clock);
    painter.setRenderer(other);
    await settle();
    expect(other.shown.at(-1)).toEqual({ offsetX: 2, detail: "whole", pieces: 100_000 });
    expect(card.shown).toEqual([]);
  });
});
