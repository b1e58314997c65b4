/** Words of the simulated pen. */
export const swingText = {
  legend: "Legend of the simulated pen",
  title: "Pen beside the line",
  unit: "mm",
  working: (percent: string) => `Simulating the pen… ${percent} %`,
  atMost: (max: string, most: string) => `At most ${max} mm, 99 % below ${most} mm`,
  orMore: (mm: string) => `≥ ${mm}`,
  asked: "What was asked",
  measured: (x: string, y: string) => `Your plotter’s swing: ${x} Hz along x, ${y} Hz along y`,
  assumed: (x: string, y: string) => `Assumed swing: ${x} Hz along x, ${y} Hz along y.`,
  measure: "Measure yours…",
  failed: "The pen could not be simulated: the drawing may be too large for this device’s memory.",
};
