import { useState } from "react";
import type { Box } from "../../../src/internal.js";
import {
  ALIGNMENTS,
  aligned,
  boxOf,
  boxOfAll,
  frameOf,
  inFrame,
  movedBy,
  type Alignment,
} from "../../scene/arrange.js";
import { wholeTurn, type FrameMm } from "../../scene/placing.js";
import { eachOf } from "../../state/sheet-edits.js";
import type { PlacedPiece, SheetRoom } from "../../state/sheet-settings.js";
import { useActions } from "../../state/use-store.js";
import { Button } from "../../ui/button.js";
import { Segments } from "../../ui/fields/choice.js";
import { NumberField } from "../../ui/fields/number-field.js";
import { sheetText as words } from "./text.js";

/** Place, size and turn of one drawing by numbers, and aligning of all that are selected. */
export const SelectedPieces = ({ selected }: { selected: readonly PlacedPiece[] }) => (
  <>
    {selected.length === 1 ? (
      <PieceFields key={selected[0].id} piece={selected[0]} />
    ) : (
      <p className="note">{words.selected(selected.length)}</p>
    )}
    <Aligning selected={selected} />
  </>
);

const rounded = (value: number): number => Math.round(value * 100) / 100;
const LENGTH = { unit: "mm", step: 1, max: 10_000 } as const;

const PieceFields = ({ piece }: { piece: PlacedPiece }) => {
  const { editSheet } = useActions();
  const frame = frameOf(piece);
  const box = boxOf(piece);
  const edit = (what: string, change: (now: PlacedPiece) => PlacedPiece): void =>
    void editSheet(`${what} ${piece.id}`, eachOf([piece.id], change));
  const size = (what: string, factor: number): void =>
    edit(what, (now) => {
      const { x0, y0 } = boxOf(now);
      const { widthMm, heightMm, ...rest } = frameOf(now);
      const sized = inFrame(now, { ...rest, widthMm: widthMm * factor, heightMm: heightMm * factor });
      const after = boxOf(sized);
      return movedBy(sized, x0 - after.x0, y0 - after.y0);
    });
  const turn = (turnDeg: number): void =>
    edit("turn", (now) => inFrame(now, { ...frameOf(now), turnDeg: wholeTurn(turnDeg) } satisfies FrameMm));
  return (
    <div className="field-pair">
      <NumberField
        label={words.x}
        value={rounded(box.x0)}
        {...LENGTH}
        min={-10_000}
        onChange={(mm) => edit("x", (now) => movedBy(now, mm - boxOf(now).x0, 0))}
      />
      <NumberField
        label={words.y}
        value={rounded(box.y0)}
        {...LENGTH}
        min={-10_000}
        onChange={(mm) => edit("y", (now) => movedBy(now, 0, mm - boxOf(now).y0))}
      />
      {frame.widthMm > 0 && (
        <NumberField
          label={words.width}
          value={rounded(frame.widthMm)}
          {...LENGTH}
          min={0.1}
          onChange={(mm) => size("width", mm / frame.widthMm)}
        />
      )}
      {frame.heightMm > 0 && (
        <NumberField
          label={words.height}
          value={rounded(frame.heightMm)}
          {...LENGTH}
          min={0.1}
          onChange={(mm) => size("height", mm / frame.heightMm)}
        />
      )}
      <NumberField
        label={words.scale}
        value={rounded(100 * Math.hypot(piece.map.a, piece.map.b))}
        unit="%"
        min={0.1}
        max={100_000}
        step={5}
        onChange={(pct) => size("scale", pct / (100 * Math.hypot(piece.map.a, piece.map.b)))}
      />
      <NumberField
        label={words.turn}
        value={rounded(frame.turnDeg)}
        unit="°"
        min={-360}
        max={360}
        step={5}
        onChange={turn}
      />
    </div>
  );
};

const TARGETS = ["paper", "inside", "each"] as const;
type Target = (typeof TARGETS)[number];

const Aligning = ({ selected }: { selected: readonly PlacedPiece[] }) => {
  const [to, setTo] = useState<Target>("inside");
  const { editSheet } = useActions();
  const ids = selected.map(({ id }) => id);
  // One drawing is not aligned to itself.
  const target = to === "each" && ids.length < 2 ? "inside" : to;
  const boxIn = ({ paper, inside }: SheetRoom): Box =>
    target === "paper" ? paper : target === "inside" ? inside : boxOfAll(selected);
  const align = (how: Alignment): void =>
    void editSheet(
      `align ${how} ${ids.join()}`,
      eachOf(ids, (piece, room) => aligned(piece, how, boxIn(room))),
    );
  return (
    <>
      <Segments
        label={words.alignTo}
        value={target}
        options={TARGETS.map((value) => ({
          value,
          label: words.targets[value],
          isOff: value === "each" && ids.length < 2,
        }))}
        onChange={(value) => setTo(value)}
      />
      <div className="align-grid" role="group" aria-label={words.align}>
        {ALIGNMENTS.map((how) => (
          <Button key={how} kind="small" onClick={() => align(how)}>
            {words.alignments[how]}
          </Button>
        ))}
      </div>
    </>
  );
};
