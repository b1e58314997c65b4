/** The panels that show parts of several features. */
import { LayersPanel } from "../layers/layers.js";
import { MotionPanel } from "../motion/motion.js";
import { PenPanel, PensPanel } from "../pens/pens.js";
import { Tuning } from "../pens/tuning.js";
import { MachinePanel, MachineSetUp, PresetsPanel } from "../plotter/machine.js";
import { QueuePanel } from "../queue/queue.js";
import { shownView } from "../state/store.js";
import { usePageState } from "../state/use-store.js";
import { lazyPart } from "../ui/lazy-part.js";

const Adjust = lazyPart(async () => (await import("../watch/adjust.js")).Adjust);
const RecentSheets = lazyPart(async () => (await import("../gallery/sheet-tile.js")).RecentSheets);
const Camera = lazyPart(async () => (await import("../sharing/camera.js")).Camera);

export const LayersAndPens = () => (
  <LayersPanel>
    <PensPanel />
  </LayersPanel>
);

export const SpeedAndPresets = () => (
  <>
    <MotionPanel />
    <PresetsPanel />
  </>
);

export const PlotterAndSetUp = () => {
  const hasCamera = usePageState((state) => state.view.cameraUrl !== "");
  return (
    <>
      {hasCamera && <Camera />}
      <MachinePanel>
        <Tuning />
      </MachinePanel>
      <MachineSetUp>
        <PenPanel />
      </MachineSetUp>
    </>
  );
};

/** In Watch, what can be changed while it plots comes first. */
export const QueueAndSheets = () => {
  const isWatching = usePageState((state) => shownView(state) === "watch");
  return (
    <>
      {isWatching && <Adjust />}
      <QueuePanel />
      <RecentSheets />
    </>
  );
};
