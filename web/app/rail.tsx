import type { PanelName } from "../state/persist.js";
import { openPanel, panelsOf } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { Icon, type IconName } from "../ui/icon.js";
import { railText as words } from "./text.js";

/** Of the panel that a button of the rail opens. */
export const PANEL_ID = "panel";

const ICONS: Readonly<Record<PanelName, IconName>> = {
  drawing: "file",
  paper: "paper",
  layers: "layers",
  lines: "lines",
  speed: "speed",
  plotter: "plotter",
  queue: "queue",
};

/** Opens one panel beside the sheet, or closes it. */
export const Rail = () => {
  const panels = usePageState(panelsOf);
  const open = usePageState(openPanel);
  const waiting = usePageState(({ jobs }) => jobs.filter(({ state }) => state === "queued").length);
  const { showPanel } = useActions();
  return (
    <nav className="rail" aria-label={words.label}>
      {panels.map((name) => (
        <button
          key={name}
          type="button"
          aria-expanded={name === open}
          aria-controls={name === open ? PANEL_ID : undefined}
          onClick={() => showPanel(name === open ? null : name)}
        >
          <Icon name={ICONS[name]} />
          <span>{words.panels[name]}</span>
          {name === "queue" && waiting > 0 && <span className="rail-count">{waiting}</span>}
        </button>
      ))}
    </nav>
  );
};
