/** Texts of the console. */
export const consoleText = {
  title: (plotter: string) => `Console of ${plotter}`,
  log: "Commands and replies",
  command: "Command",
  send: "Send",
  noReply: "(no reply)",
  refused: "A plot is running. Commands sent now would spoil it.",
  hint: "For those who know the board’s commands (QS, QM, V …). Arrow up shows earlier ones.",
};
