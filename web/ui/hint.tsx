import { useState, type ReactNode } from "react";
import { hintText } from "./text.js";

interface Hint {
  /** The "?" button, to be put beside what it explains. */
  readonly button: ReactNode;
  /** The help, hidden until the button is pressed. */
  readonly note: ReactNode;
}

/** Help on demand: a "?" that shows and hides a note with this id. Both are null without help. */
export const useHint = (about: string, noteId: string, help: string | undefined): Hint => {
  const [isShown, setShown] = useState(false);
  if (help === undefined) return { button: null, note: null };
  const button = (
    <button
      type="button"
      className="hint-button"
      aria-label={hintText.about(about)}
      title={hintText.about(about)}
      aria-expanded={isShown}
      aria-controls={noteId}
      onClick={() => setShown(!isShown)}
    >
      ?
    </button>
  );
  const note = (
    <p id={noteId} className="note" hidden={!isShown}>
      {help}
    </p>
  );
  return { button, note };
};
