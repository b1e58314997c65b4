import { STAIRS_MM, stairsPath } from "../../src/internal.js";

const ROOM_MM = 9;

interface SheetPictureProps {
  /** The label beside each line of steps, beginning at the bottom left. */
  readonly labels: readonly string[];
  readonly nextMm: number;
  /** Index of the chosen line; null: none. */
  readonly chosen: number | null;
  /** Called when a line is clicked. The controls beside the picture do the same. */
  onChoose(index: number): void;
}

/** A picture of the sheet with its lines of steps. */
export const SheetPicture = ({ labels, nextMm, chosen, onChoose }: SheetPictureProps) => {
  const last = labels.length - 1;
  const size = STAIRS_MM + last * nextMm;
  const labelRoom = 38;
  return (
    <svg
      className="sheet-picture"
      viewBox={`${-ROOM_MM} ${-ROOM_MM} ${size + 2 * ROOM_MM + labelRoom} ${size + 2 * ROOM_MM}`}
      aria-hidden="true"
    >
      <rect
        className="sheet-paper"
        x={-ROOM_MM}
        y={-ROOM_MM}
        width={size + 2 * ROOM_MM + labelRoom}
        height={size + 2 * ROOM_MM}
        rx="2"
      />
      {labels.map((label, i) => {
        const x = i * nextMm;
        const y = (last - i) * nextMm;
        return (
          <g
            key={label}
            className="sheet-figure"
            data-chosen={i === chosen || undefined}
            onClick={() => onChoose(i)}
          >
            <path className="sheet-reach" d={stairsPath(x, y)} style={{ strokeWidth: nextMm }} />
            <path className="sheet-line" d={stairsPath(x, y)} />
            <text
              x={x + STAIRS_MM + 2}
              y={y + STAIRS_MM + 1.5}
              style={{ fontSize: Math.min(6, nextMm * 0.6) }}
            >
              {label}
            </text>
          </g>
        );
      })}
    </svg>
  );
};
