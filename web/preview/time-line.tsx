import { lazy, Suspense, useRef, type RefObject } from "react";
import { drawnUntilS } from "./drawn-until.js";
import { useActions, usePageState } from "../state/use-store.js";
import { GRAPH, PLAY } from "./preview-actions.js";
import { timeLineText as words } from "./text.js";
import { ActionButton } from "../ui/action-button.js";
import { formatMoment } from "../ui/format.js";

const Graph = lazy(async () => ({ default: (await import("./graph.js")).Graph }));
const STEPS = 2_000;
const PLAY_RATES = [1, 2, 5, 10, 20, 50, 100];

/** The time line of the plot: drag along it, play it, show speed and acceleration. */
export const TimeLine = () => {
  const totalS = usePageState((state) => state.planned?.trajectory.totalS ?? 0);
  const isOpen = usePageState((state) => state.view.showGraph);
  const { seek } = useActions();
  const slider = useRef<HTMLInputElement>(null);
  if (totalS === 0) return null;
  return (
    <section className="time-line" aria-label={words.title}>
      <div className="time-row">
        <PlayButton />
        <Scrubber totalS={totalS} slider={slider} />
        <Moment totalS={totalS} />
        <RateSelect />
        <GraphButton />
      </div>
      {isOpen && (
        <Suspense fallback={<div className="graph" />}>
          <Graph slider={slider} onSeek={seek} />
        </Suspense>
      )}
    </section>
  );
};

const PlayButton = () => {
  const isPlaying = usePageState((state) => state.isPlaying);
  return <ActionButton action={PLAY} kind="tool" icon={isPlaying ? "pause" : "play"} />;
};

/** The shown moment, else how far this drawing has been plotted; null: the end. */
const useMoment = (): number | null => usePageState((state) => state.momentS ?? drawnUntilS(state));

const Scrubber = ({ totalS, slider }: { totalS: number; slider: RefObject<HTMLInputElement | null> }) => {
  const momentS = useMoment() ?? totalS;
  const { seek, stopPlaying } = useActions();
  return (
    <input
      ref={slider}
      type="range"
      aria-label={words.scrub}
      aria-valuetext={formatMoment(momentS)}
      min={0}
      max={totalS}
      step={totalS / STEPS}
      value={momentS}
      onChange={(event) => {
        stopPlaying();
        seek(Number(event.target.value));
      }}
    />
  );
};

const Moment = ({ totalS }: { totalS: number }) => {
  const momentS = useMoment();
  return (
    <span className="moment">
      {formatMoment(momentS ?? totalS)}
      <span className="note"> / {formatMoment(totalS)}</span>
    </span>
  );
};

const RateSelect = () => {
  const { setPlayRate } = useActions();
  const playRate = usePageState((state) => state.playRate);
  return (
    <label className="tool-select">
      <span className="visually-hidden">{words.rate}</span>
      <select
        value={playRate}
        title={words.rate}
        onChange={(event) => setPlayRate(Number(event.target.value))}
      >
        {PLAY_RATES.map((rate) => (
          <option key={rate} value={rate}>
            {rate}×
          </option>
        ))}
      </select>
    </label>
  );
};

const GraphButton = () => {
  const showGraph = usePageState((state) => state.view.showGraph);
  return <ActionButton action={GRAPH} kind="tool" icon="graph" isPressed={showGraph} />;
};
