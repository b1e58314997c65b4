import { RINGING_SHEET_MM, ringingPath } from "../../src/internal.js";

const ROOM_MM = 5;

/** The ringing sheet as it is plotted: lines for y on the left, for x on the right. */
export const StripPicture = () => {
  const { width, height } = RINGING_SHEET_MM;
  const room = 2 * ROOM_MM;
  return (
    <svg
      className="strip-picture"
      viewBox={`${-ROOM_MM} ${-ROOM_MM} ${width + room} ${height + room}`}
      aria-hidden="true"
    >
      <rect
        className="sheet-paper"
        x={-ROOM_MM}
        y={-ROOM_MM}
        width={width + room}
        height={height + room}
        rx="1.5"
      />
      <path className="strip-line" data-axis="y" d={ringingPath("y")} />
      <path className="strip-line" data-axis="x" d={ringingPath("x")} />
      <text x="20" y="13.2">
        y
      </text>
      <text x="51" y="21">
        x
      </text>
    </svg>
  );
};
