import { Button } from "../ui/button.js";
import { errorText } from "../ui/text.js";

/** A message instead of an empty window when rendering the page has failed. */
export const Crash = ({ message }: { message: string }) => (
  <main className="crash" role="alert">
    <h1>{errorText.title}</h1>
    <p>{errorText.unexpected}</p>
    <p className="note">{message}</p>
    <Button kind="primary" onClick={() => location.reload()}>
      {errorText.reload}
    </Button>
  </main>
);
