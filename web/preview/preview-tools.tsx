import type { RefObject } from "react";
import { useActions, usePageState } from "../state/use-store.js";
import { previewText } from "./text.js";
import { Icon, type IconName } from "../ui/icon.js";
import { placeOfFrame } from "../scene/placing.js";
import type { Stage } from "./stage.js";

const words = previewText;
const ZOOM_STEP = 1.5;

/** The controls on the desk beside the paper. */
export const PreviewTools = ({ stage }: { stage: RefObject<Stage | null> }) => {
  const showTravel = usePageState((state) => state.view.showTravel);
  const { changeView } = useActions();
  return (
    <div className="preview-tools">
      <button
        type="button"
        className="tool tool-wide"
        aria-pressed={showTravel}
        onClick={() => changeView({ showTravel: !showTravel })}
      >
        <Icon name="travel" />
        {words.travel}
      </button>
      <PlaceTool />
      <span className="tool-gap" />
      <Tool icon="minus" isZoom label={words.zoomOut} onClick={() => stage.current?.zoomBy(1 / ZOOM_STEP)} />
      <Tool icon="plus" isZoom label={words.zoomIn} onClick={() => stage.current?.zoomBy(ZOOM_STEP)} />
      <Tool icon="fit" label={words.fitPaper} onClick={() => stage.current?.fit()} />
    </div>
  );
};

/** Places the drawing by hand, with handles around it. Pressed again, the drawing fits the paper. */
const PlaceTool = () => {
  const frame = usePageState((state) => state.planned?.frameMm ?? null);
  const isPlaced = usePageState(({ settings }) => settings.prepare.place !== null);
  const { changeSettings } = useActions();
  return (
    <button
      type="button"
      className="tool"
      aria-label={words.place}
      title={words.place}
      aria-pressed={isPlaced}
      disabled={!frame}
      onClick={() =>
        changeSettings("place by hand", (settings) => ({
          ...settings,
          prepare: { ...settings.prepare, place: isPlaced || !frame ? null : placeOfFrame(frame) },
        }))
      }
    >
      <Icon name="place" />
    </button>
  );
};

interface ToolProps {
  readonly icon: IconName;
  readonly label: string;
  readonly isZoom?: boolean;
  onClick(): void;
}

const Tool = ({ icon, label, isZoom, onClick }: ToolProps) => (
  <button
    type="button"
    className={isZoom ? "tool tool-zoom" : "tool"}
    aria-label={label}
    title={label}
    onClick={onClick}
  >
    <Icon name={icon} />
  </button>
);
