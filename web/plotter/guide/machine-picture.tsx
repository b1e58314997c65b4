/** Simple drawings of the plotters, seen from above, the EggBot from the front. */
import type { ReactNode } from "react";

/** Pen holder at the end of the arm. */
const pen = (x: number, y: number): ReactNode => (
  <>
    <rect x={x - 4} y={y - 3} width="8" height="6" rx="1.5" className="machine-body" />
    <circle cx={x} cy={y + 5.5} r="2" className="machine-pen" />
  </>
);

const sheet = (x: number, y: number, width: number, height: number): ReactNode => (
  <rect x={x} y={y} width={width} height={height} className="machine-paper" />
);

const PICTURES = {
  /** A slim beam between two feet, with the arm across it. */
  v3: (
    <>
      {sheet(18, 20, 40, 26)}
      <rect x="6" y="9" width="60" height="5" rx="2.5" className="machine-body" />
      <rect x="4" y="6" width="9" height="11" rx="2" className="machine-body" />
      <rect x="59" y="6" width="9" height="11" rx="2" className="machine-body" />
      <rect x="30" y="2" width="3.6" height="32" rx="1" className="machine-body" />
      <rect x="26" y="7.5" width="11.6" height="8" rx="1.5" className="machine-body" />
      {pen(31.8, 34)}
    </>
  ),
  /** A heavy beam between two solid blocks. */
  se: (
    <>
      {sheet(14, 20, 46, 27)}
      <rect x="8" y="6.5" width="56" height="9" rx="1" className="machine-body" />
      <path d="M8 11h56" className="machine-detail" />
      <rect x="3" y="3" width="8" height="16" rx="1" className="machine-body" />
      <rect x="61" y="3" width="8" height="16" rx="1" className="machine-body" />
      <rect x="36" y="1.5" width="5" height="33" rx="1" className="machine-body" />
      <rect x="31.5" y="5" width="14" height="12" rx="1" className="machine-body" />
      {pen(38.5, 35)}
    </>
  ),
  /** Small, on a flat base that is as wide as the beam. */
  mini: (
    <>
      {sheet(27, 23, 21, 15)}
      <path d="M20 6h32v12h-5v-5H25v5h-5z" className="machine-body" />
      <rect x="34" y="3" width="3" height="23" rx="1" className="machine-body" />
      <rect x="31" y="7" width="9" height="6.5" rx="1" className="machine-body" />
      {pen(35.5, 26)}
    </>
  ),
  /** The beam ends in a case with the electronics. */
  nextdraw: (
    <>
      {sheet(18, 20, 40, 26)}
      <rect x="8" y="8" width="58" height="7" rx="3.5" className="machine-body" />
      <rect x="3" y="4" width="13" height="15" rx="4" className="machine-body" />
      <circle cx="9.5" cy="11.5" r="2" className="machine-detail" />
      <rect x="60" y="5" width="8" height="13" rx="3.5" className="machine-body" />
      <rect x="33" y="1.5" width="5" height="32" rx="2.5" className="machine-body" />
      <rect x="28.5" y="6" width="14" height="11" rx="3.5" className="machine-body" />
      {pen(35.5, 34)}
    </>
  ),
  /** A beam of two rails between long feet, with a broad arm across it. */
  idraw: (
    <>
      {sheet(16, 21, 42, 26)}
      <path d="M10 8h52M10 14h52" className="machine-detail" />
      <rect x="4" y="2" width="7" height="22" rx="1" className="machine-body" />
      <rect x="61" y="2" width="7" height="22" rx="1" className="machine-body" />
      <rect x="26" y="1.5" width="7" height="32" rx="1" className="machine-body" />
      <path d="M29.5 2v31" className="machine-detail" />
      <rect x="22.5" y="5" width="14" height="12" rx="2" className="machine-body" />
      {pen(29.5, 34)}
    </>
  ),
  /** An egg between two holders, and the arm over it. */
  egg: (
    <>
      <path d="M10 44h52" className="machine-detail" />
      <rect x="9" y="20" width="8" height="24" rx="1" className="machine-body" />
      <rect x="55" y="20" width="8" height="24" rx="1" className="machine-body" />
      <path d="M17 27h4M51 27h4" className="machine-detail" />
      <ellipse cx="36" cy="27" rx="15" ry="11.5" className="machine-paper" />
      <path d="M60 20V8H36" className="machine-detail" />
      <rect x="32.5" y="4" width="7" height="8" rx="1.5" className="machine-body" />
      <path d="M36 12v3.5" className="machine-line" />
    </>
  ),
  /** A frame with a carriage on two crossed rods, and a box of paints. */
  watercolor: (
    <>
      <rect x="5" y="4" width="62" height="40" rx="2" className="machine-body" />
      {sheet(22, 9, 40, 30)}
      <rect x="9" y="9" width="8" height="30" rx="1.5" className="machine-body" />
      {[12.5, 17.5, 22.5, 27.5, 32.5, 36].map((y) => (
        <circle key={y} cx="13" cy={y} r="1.5" className="machine-detail" />
      ))}
      <path d="M41 5v38M6 22h60" className="machine-detail" />
      <rect x="37" y="18" width="8" height="8" rx="1.5" className="machine-body" />
      <circle cx="41" cy="22" r="1.8" className="machine-pen" />
    </>
  ),
  /** The arm pulled back, and the carriage pushed to the left: the pen is over the home corner. */
  corner: (
    <>
      {sheet(14, 18, 46, 28)}
      <rect x="6" y="8" width="60" height="5" rx="2.5" className="machine-body" />
      <rect x="12" y="1" width="3.6" height="13" rx="1" className="machine-body" />
      <rect x="8" y="6.5" width="11.6" height="8" rx="1.5" className="machine-body" />
      <circle cx="14" cy="18" r="3" className="machine-pen" />
      <path d="M36 32L20.5 22.2M27 22.8L20.5 22.2L23.8 28" className="machine-arrow" />
    </>
  ),
} as const;

export type MachinePictureName = keyof typeof PICTURES;

export const MachinePicture = ({ name }: { readonly name: MachinePictureName }) => (
  <svg className="machine-picture" viewBox="0 0 72 50" aria-hidden="true">
    {PICTURES[name]}
  </svg>
);
