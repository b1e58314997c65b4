/** Texts of errors in requests to the server. */
export const serverText = {
  server: (status: number) => `The server answered with an error (${status}). Try again.`,
  unreachable: "The server can’t be reached. Is plotwright still running?",
};
