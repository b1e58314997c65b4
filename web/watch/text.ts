/** Texts of Watch, which shows the running plot. */
export const watchText = {
  status: "Plot under way",
  sheet: "Sheet",
  canvas: "The plot: what is drawn, and what is left",
  nothing: "Nothing is being plotted.",
  nothingHint: "A plot shows here from its first stroke to its last.",
  toPrepare: "Prepare a drawing",
  left: "left",
  lastSeen: (share: string) => `Last seen ${share}`,
  lastSeenHint: "The plotter may still be drawing.",
  layer: (number: number, count: number, name: string) => `Layer ${number} of ${count}, ${name}`,
  pen: (name: string) => `pen “${name}”`,
  adjust: "While it plots",
  fullScreen: "Full screen",
  endFullScreen: "Exit full screen",
  cannotShow: "The drawing can’t be shown here. The plot continues.",
};
