import type { RefObject } from "react";
import { useActions, usePageState } from "../state/use-store.js";
import { previewText as words } from "./text.js";
import { Button, IconButton } from "../ui/button.js";
import { Icon } from "../ui/icon.js";
import { usePrepareChange } from "../ui/use-change.js";
import { placeOfFrame } from "../scene/placing.js";
import type { Stage } from "./stage.js";

const ZOOM_STEP = 1.5;

/** The controls on the desk beside the paper. */
export const PreviewTools = ({ stage }: { stage: RefObject<Stage | null> }) => {
  const showTravel = usePageState((state) => state.view.showTravel);
  const { changeView } = useActions();
  return (
    <div className="preview-tools">
      <Button
        kind="tool"
        className="tool-wide"
        aria-pressed={showTravel}
        onClick={() => changeView({ showTravel: !showTravel })}
      >
        <Icon name="travel" />
        {words.travel}
      </Button>
      <PlaceTool />
      <span className="tool-gap" />
      <ZoomTools stage={stage} className="tool-zoom" />
    </div>
  );
};

/** Places the drawing by hand, with handles around it. A second press fits the drawing to the paper again. */
const PlaceTool = () => {
  const frame = usePageState((state) => state.planned?.frameMm ?? null);
  const isPlaced = usePageState(({ settings }) => settings.prepare.place !== null);
  const change = usePrepareChange();
  return (
    <IconButton
      kind="tool"
      icon="place"
      label={words.place}
      aria-pressed={isPlaced}
      disabled={!frame}
      onClick={() => change("place by hand", { place: isPlaced || !frame ? null : placeOfFrame(frame) })}
    />
  );
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
