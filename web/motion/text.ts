/** Texts of the quality. */
export const motionText = {
  title: "Speed",
  quality: "Quality",
  qualities: { fine: "Fine", normal: "Normal", fast: "Fast", custom: "Custom" },
  hints: {
    fine: "Most exact, and still faster than before the plotter was measured.",
    normal: "Faster, and close to the drawing.",
    fast: "Fastest. About as exact as before the plotter was measured.",
    custom: "Your own numbers, under Details. Choosing a quality above replaces them.",
  },
  plainHint: "Works for any plotter.",
  figures: (speed: string, accel: string, corner: string) =>
    `Pen down: up to ${speed} mm/s, ${accel} mm/s², corners rounded by ${corner}`,
  unmeasured:
    "For Fine and Fast, plotwright has to know how your plotter swings. Ten minutes with the ringing sheet make plots faster and more exact.",
  measured: (x: string, y: string) => `This plotter swings at ${x} Hz along x and ${y} Hz along y.`,
  measure: "Measure ringing…",
  measureAgain: "Measure again…",
  showSwing: "Show what the pen draws",
  details: "Details",
};
