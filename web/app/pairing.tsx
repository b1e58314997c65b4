import { useActions } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { appName } from "../ui/text.js";
import { pairingText as words } from "./text.js";
import { Mark } from "./top-bar.js";
import "./pairing.css";

/** Shown instead of the page on a device that the server does not know. */
export const Pairing = () => {
  const { loadServerState } = useActions();
  return (
    <main className="pairing">
      <p className="pairing-brand">
        <Mark />
        {appName}
      </p>
      <h1>{words.title}</h1>
      <p>{words.why}</p>
      <ol>
        {words.steps.map((step) => (
          <li key={step}>{step}</li>
        ))}
      </ol>
      <p className="note">{words.terminal}</p>
      <Button kind="primary" onClick={() => void loadServerState()}>
        {words.retry}
      </Button>
    </main>
  );
};
