/** Reordering a list by one row's handle: dragged with mouse, pen or finger, or moved by the arrow keys. */
import { useEffect, useRef, type KeyboardEvent, type PointerEvent, type RefObject } from "react";

/** The new index of a row dropped at `yPx`, given the centres of the other rows from top to bottom. */
export const slotOfDrop = (middlesPx: readonly number[], yPx: number): number =>
  middlesPx.filter((middlePx) => middlePx < yPx).length;

/**
 * The row before which `id` has to be moved so that its index becomes `place`; null for the end.
 * Undefined if it is there already, or if there is no such index.
 */
export const placeAfterMove = (
  ids: readonly string[],
  id: string,
  slot: number,
): string | null | undefined => {
  if (slot < 0 || slot >= ids.length || ids[slot] === id) return undefined;
  const others = ids.filter((other) => other !== id);
  return others[slot] ?? null;
};

interface RowDrag {
  readonly fromPx: number;
  readonly row: HTMLElement;
  readonly others: readonly HTMLElement[];
  readonly middlesPx: readonly number[];
}

/** Handlers for the handle of the row `data-row={id}` of `list`, now at `index`. `onMove` gets the new index. */
export const useRowDrag = (
  list: RefObject<HTMLUListElement | null>,
  id: string,
  index: number,
  onMove: (place: number) => void,
) => {
  const drag = useRef<RowDrag | null>(null);
  const end = (): void => {
    if (drag.current) showDrop(drag.current, null);
    drag.current = null;
  };
  useEffect(() => end, []);
  return {
    onPointerDown: (event: PointerEvent<HTMLElement>): void => {
      if (event.button !== 0) return;
      const rows = [...(list.current?.querySelectorAll<HTMLElement>("[data-row]") ?? [])];
      const row = rows.find((one) => one.dataset.row === id);
      if (!row) return;
      event.currentTarget.setPointerCapture(event.pointerId);
      const others = rows.filter((one) => one !== row);
      const middlesPx = others.map((one) => {
        const { top, height } = one.getBoundingClientRect();
        return top + height / 2;
      });
      drag.current = { fromPx: event.clientY, row, others, middlesPx };
    },
    onPointerMove: (event: PointerEvent<HTMLElement>): void => {
      if (drag.current) showDrop(drag.current, event.clientY);
    },
    onPointerUp: (event: PointerEvent<HTMLElement>): void => {
      const was = drag.current;
      end();
      if (was && event.clientY !== was.fromPx) onMove(slotOfDrop(was.middlesPx, event.clientY));
    },
    onPointerCancel: end,
    onKeyDown: (event: KeyboardEvent): void => {
      const step = event.key === "ArrowUp" ? -1 : event.key === "ArrowDown" ? 1 : 0;
      if (step === 0) return;
      event.preventDefault();
      onMove(index + step);
    },
  };
};

/** Moves the row with the pointer and marks where it would be dropped; null: resets both. */
const showDrop = ({ fromPx, row, others, middlesPx }: RowDrag, yPx: number | null): void => {
  const place = yPx === null ? -1 : slotOfDrop(middlesPx, yPx);
  row.style.transform = yPx === null ? "" : `translateY(${yPx - fromPx}px)`;
  row.toggleAttribute("data-dragged", yPx !== null);
  others.forEach((other, index) => {
    other.toggleAttribute("data-drop-before", index === place);
    other.toggleAttribute("data-drop-after", place === others.length && index === place - 1);
  });
};
