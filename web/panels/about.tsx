import { useEffect, useState } from "react";
import { usePageState, usePageStore } from "../state/use-store.js";
import { later } from "../text/later.js";
import { Dialog } from "../ui/dialog.js";

const words = later.about;

/** Which version this is, and the licences of all that is built into the page. */
export const AboutDialog = () => {
  const store = usePageStore();
  const version = usePageState((state) => state.version);
  const licences = useLicences();
  return (
    <Dialog title={words.title} onClose={() => store.setState({ openDialog: null })}>
      <p>{version === null ? words.what : words.whatVersion(version)}</p>
      <p className="note">{words.licences}</p>
      <pre className="licences" tabIndex={0} aria-label={words.licencesLabel}>
        {licences}
      </pre>
    </Dialog>
  );
};

/** The build writes them beside the page; while it is developed there is no such file. */
function useLicences(): string {
  const [licences, setLicences] = useState<string>(words.loading);
  useEffect(() => {
    const stop = new AbortController();
    fetch("/licences.txt", { signal: stop.signal })
      .then(async (response) => {
        const isText = response.headers.get("Content-Type")?.startsWith("text/plain") === true;
        setLicences(response.ok && isText ? await response.text() : words.absent);
      })
      .catch(() => {
        if (!stop.signal.aborted) setLicences(words.absent);
      });
    return () => stop.abort();
  }, []);
  return licences;
}
