import { usePageStore } from "../state/use-store.js";
import type { Shortcut } from "../state/shortcuts.js";
import { text } from "../text/text.js";
import { later } from "../text/later.js";
import { Dialog } from "../ui/dialog.js";

const words = text.shortcuts;

/** The sheet with all keys. */
export const HelpSheet = ({ shortcuts }: { shortcuts: readonly Shortcut[] }) => {
  const store = usePageStore();
  return (
    <Dialog title={words.title} onClose={() => store.setState({ openDialog: null })}>
      <dl className="key-list">
        {shortcuts.map(({ keys, label }) => (
          <div key={keys}>
            <dt>
              {keys.split(" ").map((key) => (
                <kbd key={key}>{key}</kbd>
              ))}
            </dt>
            <dd>{label}</dd>
          </div>
        ))}
      </dl>
      <p className="note">{text.preview.hint}</p>
      <p className="note">{words.fields}</p>
      <button type="button" className="link" onClick={() => store.setState({ openDialog: "about" })}>
        {later.about.title}
      </button>
    </Dialog>
  );
};
