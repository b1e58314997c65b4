import { crestsOf, ringingLine, STRAIGHT_MM, type Axis, type Springs } from "../../src/internal.js";

/** Before the bend this much of the line is shown, mm. */
const BEFORE_MM = 4;
const BESIDE_MM = { out: 2.6, in: 2.2 };
const RULER_MM = 3.4;
/** A person sees ripples down to this height, mm. */
const SEEN_MM = 0.06;

interface PictureProps {
  readonly axis: Axis;
  readonly springs: Springs;
}

interface CountedPictureProps extends PictureProps {
  /** How many ripples to number; null: all that are visible. */
  readonly ripples: number | null;
}

/**
 * The line of one axis as a pen on these springs draws it, with the ripples numbered and their length. Its proportions are
 * those on paper. For y it is horizontal, for x vertical.
 */
export const RipplePicture = ({ axis, springs, ripples }: CountedPictureProps) => {
  const place = placeOn(axis);
  const visible = crestsOf(ringingLine(springs, axis)).filter(({ besideMm }) => besideMm > SEEN_MM);
  const crests = visible.slice(0, ripples === null ? undefined : ripples + 1).map(({ alongMm }) => alongMm);
  const ruler = -RULER_MM;
  return (
    <svg className="ripple-picture" viewBox={viewBoxOf(axis)} aria-hidden="true" data-axis={axis}>
      <RippleLine axis={axis} springs={springs} />
      {crests.map((alongMm) => (
        <path key={alongMm} className="ripple-tick" d={`M${place(alongMm, -1.6)}L${place(alongMm, ruler)}`} />
      ))}
      {crests.length > 1 && (
        <path
          className="ripple-ruler"
          d={`M${place(crests[0], ruler)}L${place(crests[crests.length - 1], ruler)}`}
        />
      )}
      {crests.slice(1).map((alongMm, i) => {
        const [x, y] = place((alongMm + crests[i]) / 2, -2.4).split(" ");
        return (
          <text key={alongMm} x={x} y={y}>
            {i + 1}
          </text>
        );
      })}
    </svg>
  );
};

/** The same line alone, to compare how quickly the ripples fade. */
export const FadingPicture = ({ springs, axis }: PictureProps) => (
  <svg className="ripple-picture" viewBox={`0 ${-BESIDE_MM.out} 38 4.6`} aria-hidden="true">
    <RippleLine axis={axis} springs={springs} isTurned={axis === "x"} />
  </svg>
);

/** `isTurned`: horizontal also for x. */
const RippleLine = ({ axis, springs, isTurned }: PictureProps & { readonly isTurned?: boolean }) => {
  const place = placeOn(isTurned ? "y" : axis);
  const line = ringingLine(springs, axis).filter((_, i) => i % 2 === 0);
  const before = place(-BEFORE_MM, -BEFORE_MM * 0.8);
  return (
    <>
      <path className="ripple-asked" d={`M${place(0, 0)}L${place(STRAIGHT_MM, 0)}`} />
      <path
        className="ripple-line"
        d={`M${before}L${line.map(({ alongMm, besideMm }) => place(alongMm, besideMm)).join("L")}`}
      />
    </>
  );
};

/** A point along the line and beside it, on its outer side, as path data. */
const placeOn =
  (axis: Axis) =>
  (alongMm: number, besideMm: number): string => {
    const [along, beside] = [BEFORE_MM + alongMm, besideMm];
    return axis === "y"
      ? `${along.toFixed(2)} ${(-beside).toFixed(2)}`
      : `${beside.toFixed(2)} ${along.toFixed(2)}`;
  };

const viewBoxOf = (axis: Axis): string => {
  const length = BEFORE_MM + STRAIGHT_MM + 1;
  const inner = RULER_MM + 0.8;
  return axis === "y"
    ? `0 ${-BESIDE_MM.out} ${length} ${BESIDE_MM.out + inner}`
    : `${-inner} 0 ${BESIDE_MM.out + inner} ${length}`;
};
