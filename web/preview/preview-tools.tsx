import type { RefObject } from "react";
import { useActions, usePageState } from "../state/use-store.js";
import { previewText as words } from "./text.js";
import { ActionButton } from "../ui/action-button.js";
import { IconButton } from "../ui/button.js";
import { Segments, Select } from "../ui/fields/choice.js";
import { PLACE, TRAVEL } from "./preview-actions.js";
import type { Stage } from "./stage.js";
import { VIEW_MODES, viewModeOf } from "./view-modes.js";

const ZOOM_STEP = 1.5;

const MODE_OPTIONS = VIEW_MODES.map(({ id, label }) => ({ value: id, label }));

/** What the colours of the chosen view mode mean. */
export const Legend = () => {
  const mode = usePageState(viewModeOf);
  const planned = usePageState((state) => state.planned);
  const settings = usePageState((state) => state.settings);
  if (!planned || planned.scene.draw.count === 0) return null;
  return <mode.Legend planned={planned} settings={settings} />;
};

export const ViewModes = () => {
  const mode = usePageState(viewModeOf);
  const { changeView } = useActions();
  const choose = (viewMode: string): void => changeView({ viewMode });
  const control = { label: words.colorBy, value: mode.id, options: MODE_OPTIONS, onChange: choose };
  return (
    <div className="looks">
      {/* Where six names have no room beside each other; the style shows one of the two. */}
      <div className="looks-menu">
        <Select {...control} />
      </div>
      <Segments {...control} isLabelHidden />
    </div>
  );
};

/** The controls on the desk beside the paper. */
export const PreviewTools = ({ stage }: { stage: RefObject<Stage | null> }) => {
  const showTravel = usePageState((state) => state.view.showTravel);
  return (
    <div className="preview-tools">
      <ActionButton
        action={TRAVEL}
        kind="tool"
        className="tool-wide"
        icon="travel"
        isPressed={showTravel}
        hasText
      />
      <PlaceTool />
      <span className="tool-gap" />
      <ZoomTools stage={stage} className="tool-zoom" />
    </div>
  );
};

const PlaceTool = () => {
  const isPlaced = usePageState(({ settings }) => settings.prepare.layout !== null);
  return <ActionButton action={PLACE} kind="tool" icon="place" isPressed={isPlaced} />;
};

/** The buttons that zoom a sheet. `className`: for the buttons that a small screen hides. */
export const ZoomTools = ({ stage, className }: { stage: RefObject<Stage | null>; className?: string }) => (
  <>
    <IconButton
      kind="tool"
      icon="minus"
      label={words.zoomOut}
      className={className}
      onClick={() => stage.current?.zoomBy(1 / ZOOM_STEP)}
    />
    <IconButton
      kind="tool"
      icon="plus"
      label={words.zoomIn}
      className={className}
      onClick={() => stage.current?.zoomBy(ZOOM_STEP)}
    />
    <IconButton kind="tool" icon="fit" label={words.fitPaper} onClick={() => stage.current?.fit()} />
  </>
);
