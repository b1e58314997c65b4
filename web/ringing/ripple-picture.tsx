import { useId } from "react";

export type Axis = "x" | "y";

/** Units of the picture per mm. The line is drawn at 50 mm/s by a machine that swings at 15 Hz. */
const MM = 6.6;
const RIPPLE_MM = 50 / 15;
const RIPPLES = 3;
const CORNER = { along: 16, across: 34 };
const SWING = 11;
const DECAY_MM = 14;
const LENGTH_MM = 15;

/** Shows what to count: the ripples after a corner, over 10 mm. On a horizontal line for y, on a vertical one for x. */
export const RipplePicture = ({ axis }: { readonly axis: Axis }) => {
  const id = useId();
  const at = (along: number, across: number): string =>
    axis === "y" ? `${along.toFixed(1)} ${across.toFixed(1)}` : `${across.toFixed(1)} ${along.toFixed(1)}`;
  const ripple = Array.from({ length: 120 }, (_, i) => {
    const mm = (LENGTH_MM * i) / 119;
    return at(CORNER.along + mm * MM, CORNER.across + swingAt(mm));
  });
  const crests = Array.from({ length: RIPPLES + 1 }, (_, i) => (i + 0.25) * RIPPLE_MM);
  const ruler = CORNER.across + 30;
  const [first, last] = [crests[0], crests[RIPPLES]].map((mm) => CORNER.along + mm * MM);
  const text = (along: number, across: number): { x: number; y: number } =>
    axis === "y" ? { x: along, y: across } : { x: across, y: along };
  return (
    <svg
      className="ripple-picture"
      viewBox={axis === "y" ? "0 0 124 84" : "0 0 124 124"}
      aria-hidden="true"
      data-axis={axis}
    >
      <defs>
        <marker id={id} viewBox="0 0 6 6" refX="5" refY="3" markerWidth="5" markerHeight="5" orient="auto">
          <path d="M0 0L6 3L0 6z" className="ripple-arrow" />
        </marker>
      </defs>
      <path className="ripple-asked" d={`M${at(CORNER.along, CORNER.across)}L${at(120, CORNER.across)}`} />
      <path
        className="ripple-line"
        d={`M${at(CORNER.along, 4)}L${at(CORNER.along, CORNER.across)}L${ripple.join("L")}`}
      />
      <path
        className="ripple-direction"
        d={`M${at(CORNER.along - 8, 6)}L${at(CORNER.along - 8, 22)}`}
        markerEnd={`url(#${id})`}
      />
      {crests.map((mm) => {
        const along = CORNER.along + mm * MM;
        return (
          <path
            key={mm}
            className="ripple-tick"
            d={`M${at(along, CORNER.across + 16)}L${at(along, ruler)}`}
          />
        );
      })}
      <path className="ripple-ruler" d={`M${at(first, ruler)}L${at(last, ruler)}`} />
      {crests.slice(1).map((mm, i) => (
        <text key={mm} {...text(CORNER.along + (mm - RIPPLE_MM / 2) * MM, ruler - 5)}>
          {i + 1}
        </text>
      ))}
      <text {...text((first + last) / 2, ruler + 13)} className="ripple-mm">
        10 mm
      </text>
    </svg>
  );
};

/** The pen's distance from the line, in units of the picture. It starts at the corner with an overshoot. */
const swingAt = (mm: number): number =>
  SWING * Math.exp(-mm / DECAY_MM) * Math.sin((2 * Math.PI * mm) / RIPPLE_MM);
