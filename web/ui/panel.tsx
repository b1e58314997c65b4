import type { ReactNode } from "react";
import { useHint } from "./hint.js";

interface PanelProps {
  /** Its search results and its help are found by this id. */
  readonly id: string;
  readonly title: string;
  /** The panel's values in a few words, shown beside the title. */
  readonly summary?: string;
  readonly help?: string;
  readonly children: ReactNode;
}

/** Settings that the rail opens. Parts of them that are changed less often are in a `SettingsGroup`. */
export const Panel = ({ id, title, summary, help, children }: PanelProps) => {
  const hint = useHint(title, `help-${id}`, help);
  return (
    <div className="card panel-settings" id={`group-${id}`}>
      <div className="panel-top">
        <h2 className="panel-title" tabIndex={-1}>
          {title}
        </h2>
        {hint.button}
        {summary && <span className="group-summary">{summary}</span>}
      </div>
      {hint.note}
      {children}
    </div>
  );
};
