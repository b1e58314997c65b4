import { useState, type ReactNode } from "react";
import { hintText } from "./text.js";

interface Hint {
  /** The "?" button, to be put beside what it explains. */
  readonly button: ReactNode;
  readonly isShown: boolean;
}

/** Help on demand: a "?" that shows and hides the note with this id. No button without help. */
export const useHint = (about: string, noteId: string, hasHelp: boolean): Hint => {
  const [isShown, setShown] = useState(false);
  if (!hasHelp) return { button: null, isShown: false };
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
  return { button, isShown };
};
