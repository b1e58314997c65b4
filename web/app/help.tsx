import { useActions, usePageState } from "../state/use-store.js";
import { labelOf } from "../state/page-action.js";
import { ACTIONS_WITH_KEYS } from "./shortcuts.js";
import { shortcutsText as words } from "./text.js";
import { previewText } from "../preview/text.js";
import { aboutText } from "./about-text.js";
import { Button } from "../ui/button.js";
import { Sheet } from "../ui/sheet.js";
import "./sheets.css";

/** The dialog that lists all keyboard shortcuts. */
export const HelpSheet = () => {
  const { openDialog } = useActions();
  const state = usePageState((whole) => whole);
  return (
    <Sheet title={words.title}>
      <dl className="key-list">
        {ACTIONS_WITH_KEYS.map((action) => (
          <div key={action.id}>
            <dt>
              {(action.key ?? "").split(" ").map((key) => (
                <kbd key={key}>{key}</kbd>
              ))}
            </dt>
            <dd>{labelOf(action, state)}</dd>
          </div>
        ))}
      </dl>
      <p className="note">{previewText.hint}</p>
      <p className="note">{words.fields}</p>
      <Button kind="link" onClick={() => openDialog("about")}>
        {aboutText.title}
      </Button>
    </Sheet>
  );
};
