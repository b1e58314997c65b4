import "./save.css";
import { useState } from "react";
import { boardFirmware } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { saveText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { Select } from "../ui/fields/choice.js";
import { EXPORT_FORMATS, type ExportFormat } from "../worker/protocol.js";

/** One version for each set of motion commands that boards understand, newest first. */
const FIRMWARES = ["3.0.3", "3.1.7", "2.8.1", "2.7.0", "2.5.3"];

const WORDS: Record<ExportFormat, { readonly title: string; readonly hint: string }> = {
  svg: { title: words.svg, hint: words.svgHint },
  json: { title: words.json, hint: words.jsonHint },
  commands: { title: words.commands, hint: words.commandsHint },
};

export const ExportList = () => {
  const connected = usePageState(boardFirmware);
  // The worker still has the strokes of the settings before.
  const isPlanning = usePageState((state) => state.isPlanning);
  const [chosen, setChosen] = useState<string | null>(null);
  const { exportAs } = useActions();
  const firmwares = connected && !FIRMWARES.includes(connected) ? [connected, ...FIRMWARES] : FIRMWARES;
  const firmware = chosen ?? connected ?? FIRMWARES[0];
  return (
    <ul className="export-list">
      {EXPORT_FORMATS.map((format) => (
        <li key={format}>
          <div className="export-head">
            <strong>{WORDS[format].title}</strong>
            <Button
              kind="small"
              aria-label={words.save(WORDS[format].title)}
              disabled={isPlanning}
              onClick={() => exportAs(format, firmware)}
            >
              {isPlanning ? words.planning : words.saveShort}
            </Button>
          </div>
          <p className="note">{WORDS[format].hint}</p>
          {format === "commands" && (
            <Select
              label={words.firmware}
              value={firmware}
              options={firmwares.map((value) => ({ value, label: value }))}
              onChange={setChosen}
            />
          )}
        </li>
      ))}
    </ul>
  );
};
