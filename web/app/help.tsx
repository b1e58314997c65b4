import { usePageStore } from "../state/use-store.js";
import type { Shortcut } from "./shortcuts.js";
import { shortcutsText as words } from "./text.js";
import { previewText } from "../preview/text.js";
import { aboutText } from "./about-text.js";
import { Button } from "../ui/button.js";
import { Sheet } from "../ui/sheet.js";
import "./sheets.css";

/** The dialog that lists all keyboard shortcuts. */
export const HelpSheet = ({ shortcuts }: { shortcuts: readonly Shortcut[] }) => {
  const store = usePageStore();
  return (
    <Sheet title={words.title}>
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
      <p className="note">{previewText.hint}</p>
      <p className="note">{words.fields}</p>
      <Button kind="link" onClick={() => store.setState({ openDialog: "about" })}>
        {aboutText.title}
      </Button>
    </Sheet>
  );
};
