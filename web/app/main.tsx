/** Mounts the page. The only file with side effects on import. */
import { createRoot } from "react-dom/client";
import { PageContext } from "../state/use-store.js";
import { ErrorBoundary } from "../ui/lazy-part.js";
import { App } from "./app.js";
import { openPage } from "./open-page.js";
import { Button } from "../ui/button.js";
import { errorText } from "../ui/text.js";
import "./index.css";

/** A message instead of an empty window when rendering the page has failed. */
const Crash = ({ message }: { message: string }) => (
  <main className="crash" role="alert">
    <h1>{errorText.title}</h1>
    <p>{errorText.unexpected}</p>
    <p className="note">{message}</p>
    <Button kind="primary" onClick={() => location.reload()}>
      {errorText.reload}
    </Button>
  </main>
);

const root = document.getElementById("root");
if (!root) throw new Error("index.html has no #root");
// Two youngest features of which the browsers named in index.html are the first to have both: strokes are drawn in a
// worker, and styles depend on :has(). Without them, index.html's text stays.
if (typeof OffscreenCanvas !== "undefined" && CSS.supports("selector(:has(a))")) {
  createRoot(root).render(
    <ErrorBoundary fallback={(message) => <Crash message={message} />}>
      <PageContext value={openPage()}>
        <App />
      </PageContext>
    </ErrorBoundary>,
  );
}
