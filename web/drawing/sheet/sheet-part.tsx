import "./sheet.css";
import { useRef, useState } from "react";
import { frameOf, type GridWish } from "../../scene/arrange.js";
import { inGrid, piecesOnPaper } from "../../state/sheet-edits.js";
import type { PlacedPiece } from "../../state/sheet-settings.js";
import { useActions, usePageState, usePageStore } from "../../state/use-store.js";
import { Button } from "../../ui/button.js";
import { Switch } from "../../ui/fields/choice.js";
import { NumberField } from "../../ui/fields/number-field.js";
import { SettingsGroup } from "../../ui/fields/settings-group.js";
import { formatSize } from "../../ui/format.js";
import { SelectedPieces } from "./selected-pieces.js";
import { sheetText as words } from "./text.js";

/** Several drawings on the sheet: selecting, placing, copying. */
export const SheetPart = () => {
  const hasSheet = usePageState(({ drawing }) => Boolean(drawing?.sheet));
  return (
    <>
      {hasSheet && <Pieces />}
      <Grid />
    </>
  );
};

/** The pieces as they are now. */
const usePieces = (): readonly PlacedPiece[] => {
  usePageState((state) => state.drawing);
  usePageState((state) => state.planned);
  return piecesOnPaper(usePageStore().getState());
};

const Pieces = () => {
  const pieces = usePieces();
  const selectedIds = usePageState((state) => state.selectedPieces);
  const unit = usePageState((state) => state.view.lengthUnit);
  const { selectPieces, duplicatePieces, removePieces } = useActions();
  const selected = pieces.filter(({ id }) => selectedIds.includes(id));
  const ids = selected.map(({ id }) => id);
  const list = useRef<HTMLUListElement>(null);
  const remove = (): void => {
    // The button is off once nothing is selected, and would lose the focus: one of the others gets it.
    const first = pieces.findIndex(({ id }) => ids.includes(id));
    const next = pieces.findIndex(({ id }, index) => index > first && !ids.includes(id));
    list.current?.querySelectorAll("input")[next >= 0 ? next : first - 1]?.focus();
    void removePieces();
  };
  const toggle = (id: string): void =>
    selectPieces(ids.includes(id) ? ids.filter((other) => other !== id) : [...ids, id]);
  return (
    <section className="sheet-part" aria-label={words.title}>
      <ul className="sheet-pieces" aria-label={words.list} ref={list}>
        {pieces.map((piece, index) => {
          const { widthMm, heightMm } = frameOf(piece);
          return (
            <li key={piece.id}>
              <label className="sheet-piece" title={piece.name}>
                <input type="checkbox" checked={ids.includes(piece.id)} onChange={() => toggle(piece.id)} />
                <span className="sheet-piece-name">{words.piece(index + 1, piece.name)}</span>
                <span className="note">{formatSize(widthMm, heightMm, unit)}</span>
              </label>
            </li>
          );
        })}
      </ul>
      <div className="sheet-buttons">
        <Button
          kind="small"
          onClick={() => selectPieces(ids.length === pieces.length ? [] : pieces.map(({ id }) => id))}
        >
          {ids.length === pieces.length ? words.none : words.all}
        </Button>
        <Button kind="small" disabled={ids.length === 0} onClick={() => void duplicatePieces()}>
          {words.duplicate}
        </Button>
        <Button kind="small" disabled={ids.length === 0 || ids.length === pieces.length} onClick={remove}>
          {words.remove}
        </Button>
      </div>
      {selected.length === 0 ? (
        <p className="note">{words.selectHint}</p>
      ) : (
        <SelectedPieces selected={selected} />
      )}
    </section>
  );
};

const FIRST_GRID: GridWish = { columns: 2, rows: 3, gapMm: 10, fills: true };
const MAX_COPIES = 50;

const Grid = () => {
  const [wish, setWish] = useState(FIRST_GRID);
  const store = usePageStore();
  const { editSheet } = useActions();
  const isReady = usePageState(({ planned }) => (planned?.strokeCount ?? 0) > 0);
  const set = (part: Partial<GridWish>): void => setWish({ ...wish, ...part });
  const make = (): void => {
    // Pressed again with other numbers, the grid is made anew: its copies are selected.
    const { selectedPieces } = store.getState();
    void editSheet("grid", inGrid(selectedPieces, wish));
  };
  const count = { unit: "", min: 1, max: MAX_COPIES, step: 1, digits: 0 } as const;
  return (
    <SettingsGroup id="grid" title={words.grid} isPart>
      <div className="field-pair">
        <NumberField
          label={words.columns}
          value={wish.columns}
          {...count}
          onChange={(columns) => set({ columns: Math.round(columns) })}
        />
        <NumberField
          label={words.rows}
          value={wish.rows}
          {...count}
          onChange={(rows) => set({ rows: Math.round(rows) })}
        />
      </div>
      <NumberField
        label={words.gap}
        value={wish.gapMm}
        unit="mm"
        min={0}
        max={1_000}
        step={1}
        onChange={(gapMm) => set({ gapMm })}
      />
      <Switch label={words.fills} isOn={wish.fills} onChange={(fills) => set({ fills })} />
      <Button disabled={!isReady} onClick={make}>
        {words.makeGrid(wish.columns, wish.rows)}
      </Button>
    </SettingsGroup>
  );
};
