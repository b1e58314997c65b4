/** Words of the quality. */
export const motionText = {
  title: "Speed",
  quality: "Quality",
  qualities: { fine: "Fine", normal: "Normal", fast: "Fast", custom: "Custom" },
  hints: {
    fine: "Closest to the drawing, and still quicker than without the measured swing.",
    normal: "Quicker, and close to the drawing.",
    fast: "Quickest. The line is about as exact as an unmeasured plotter’s.",
    custom: "Numbers of your own, under Details. A step above replaces them.",
  },
  plainHint: "Suits any plotter.",
  figures: (speed: string, accel: string, corner: string) =>
    `Pen down: up to ${speed} mm/s, ${accel} mm/s², corners rounded by ${corner}`,
  unmeasured:
    "Fine and Fast need to know how your plotter swings. Ten minutes with the ringing sheet make it quicker and more exact.",
  measured: (x: string, y: string) => `This plotter swings at ${x} Hz along x and ${y} Hz along y.`,
  measure: "Measure ringing…",
  measureAgain: "Measure again…",
  showSwing: "Show what the pen draws",
  details: "Details",
};
