import { useEffect, useState } from "react";
import { fetchLicences } from "../pwa/licences.js";
import { usePageState } from "../state/use-store.js";
import { aboutText as words } from "./about-text.js";
import { Sheet } from "../ui/sheet.js";
import "./sheets.css";

/** Shows the version, and the licences of all software in the page. */
export const AboutDialog = () => {
  const version = usePageState((state) => state.version);
  const licences = useLicences();
  return (
    <Sheet title={words.title}>
      <p>{version === null ? words.what : words.whatVersion(version)}</p>
      <p className="note">{words.licences}</p>
      <pre className="licences" tabIndex={0} aria-label={words.licencesLabel}>
        {licences}
      </pre>
    </Sheet>
  );
};

/** The build writes the licences beside the page. The development server has no such file. */
function useLicences(): string {
  const [licences, setLicences] = useState<string>(words.loading);
  useEffect(() => {
    const stop = new AbortController();
    fetchLicences(stop.signal)
      .then((found) => setLicences(found ?? words.absent))
      .catch(() => {
        if (!stop.signal.aborted) setLicences(words.absent);
      });
    return () => stop.abort();
  }, []);
  return licences;
}
