/** Texts of what is found on the ports. */
export const findText = {
  find: "Find plotter",
  asking: "Asking what is on the ports…",
  ports: "What is on the ports",
  noAnswer: "No answer",
  use: "Use",
  useNamed: (answer: string, path: string) => `Use the ${answer} at ${path}`,
  whichModel: (answer: string) => `Models for the ${answer}`,
  nothing: "Nothing on USB that may be a plotter: check the cable and the plotter’s power.",
};
