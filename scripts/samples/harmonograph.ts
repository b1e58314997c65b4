/**
 * A dense curve in one line: the trace of four damped pendulums, as the harmonographs of the
 * nineteenth century drew them.  x = Σ A sin(f t + p) e^(−d t), y likewise.
 */
import { PAGE_HEIGHT_MM, PAGE_WIDTH_MM, samplePage, smoothPath, type Point } from "./svg.js";

interface Pendulum {
  readonly amplitudeMm: number;
  readonly frequency: number;
  readonly phase: number;
  readonly damping: number;
}

/** 2 : 3 with a second pendulum on each axis slightly out of tune: the figure drifts as it fades, and looks like a fish. */
const ALONG_X: readonly Pendulum[] = [
  { amplitudeMm: 100, frequency: 2, phase: 0.1, damping: 0.005 },
  { amplitudeMm: 28, frequency: 2.01, phase: 1, damping: 0.004 },
];
const ALONG_Y: readonly Pendulum[] = [
  { amplitudeMm: 62, frequency: 3, phase: 1.2, damping: 0.005 },
  { amplitudeMm: 24, frequency: 3.005, phase: 0, damping: 0.003 },
];

function swing(pendulums: readonly Pendulum[], t: number): { place: number; velocity: number } {
  let place = 0;
  let velocity = 0;
  for (const { amplitudeMm, frequency, phase, damping } of pendulums) {
    const decay = amplitudeMm * Math.exp(-damping * t);
    place += decay * Math.sin(frequency * t + phase);
    velocity += decay * (frequency * Math.cos(frequency * t + phase) - damping * Math.sin(frequency * t + phase));
  }
  return { place, velocity };
}

export function harmonograph(): string {
  const at = (t: number): { place: Point; velocity: Point } => {
    const x = swing(ALONG_X, t);
    const y = swing(ALONG_Y, t);
    return {
      place: [PAGE_WIDTH_MM / 2 + x.place, PAGE_HEIGHT_MM / 2 + y.place],
      velocity: [x.velocity, y.velocity],
    };
  };
  const path = smoothPath(at, 0, 300, 3000);
  return samplePage("Harmonograph", [{ name: "Pendulums", color: "#1d3f72", paths: [path] }], 0.3);
}
