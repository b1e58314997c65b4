import { useActions, usePageState } from "../state/use-store.js";
import { labelOf } from "../state/page-action.js";
import { ACTIONS_WITH_KEYS } from "./shortcuts.js";
import { shortcutsText as words, aboutText } from "./text.js";
import { previewText } from "../preview/text.js";
import { fetchLicences } from "../pwa/register.js";
import { Button } from "../ui/button.js";
import { Sheet } from "../ui/dialog.js";
import { useEffect, useState } from "react";
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

/** Shows the version, and the licences of all software in the page. */
export const AboutDialog = () => {
  const version = usePageState((state) => state.version);
  const licences = useLicences();
  return (
    <Sheet title={aboutText.title}>
      <p>{version === null ? aboutText.what : aboutText.whatVersion(version)}</p>
      <p className="note">{aboutText.licences}</p>
      <pre className="licences" tabIndex={0} aria-label={aboutText.licencesLabel}>
        {licences}
      </pre>
    </Sheet>
  );
};

/** The build writes the licences beside the page. The development server has no such file. */
function useLicences(): string {
  const [licences, setLicences] = useState<string>(aboutText.loading);
  useEffect(() => {
    const stop = new AbortController();
    fetchLicences(stop.signal)
      .then((found) => setLicences(found ?? aboutText.absent))
      .catch(() => {
        if (!stop.signal.aborted) setLicences(aboutText.absent);
      });
    return () => stop.abort();
  }, []);
  return licences;
}
