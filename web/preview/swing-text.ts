/** Texts of the simulated pen. */
export const swingText = {
  legend: "Legend of the simulated pen",
  title: "Distance from the line",
  unit: "mm",
  working: (percent: string) => `Simulating the pen… ${percent} %`,
  atMost: (max: string, p99: string) => `At most ${max} mm, 99 % below ${p99} mm`,
  orMore: (mm: string) => `≥ ${mm}`,
  asked: "Planned line",
  measured: (x: string, y: string) => `Your plotter’s swing: ${x} Hz along x, ${y} Hz along y`,
  assumed: (x: string, y: string) => `Assumed swing: ${x} Hz along x, ${y} Hz along y.`,
  measure: "Measure yours…",
  failed: "The pen could not be simulated: the drawing may be too large for this device’s memory.",
};
