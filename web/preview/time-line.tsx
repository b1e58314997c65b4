import { lazy, Suspense } from "react";
import { drawnUntilS } from "./drawn-until.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import { timeLineText as words } from "./text.js";
import { IconButton } from "../ui/button.js";
import { formatMoment } from "../ui/format.js";
import { PLAY_RATES, type Player } from "./player.js";

const Graph = lazy(async () => ({ default: (await import("./graph.js")).Graph }));
const STEPS = 2_000;

/** The time line of the plot: drag along it, play it, show speed and acceleration. */
export const TimeLine = ({ player }: { player: Player }) => {
  const totalS = usePageState((state) => state.planned?.trajectory.totalS ?? 0);
  const isOpen = usePageState((state) => state.view.showGraph);
  if (totalS === 0) return null;
  return (
    <section className="time-line" aria-label={words.title}>
      <div className="time-row">
        <PlayButton player={player} />
        <Scrubber player={player} totalS={totalS} />
        <Moment totalS={totalS} />
        <RateSelect />
        <GraphButton />
      </div>
      {isOpen && (
        <Suspense fallback={<div className="graph" />}>
          <Graph onSeek={(tS) => player.seek(tS)} />
        </Suspense>
      )}
    </section>
  );
};

const PlayButton = ({ player }: { player: Player }) => {
  const isPlaying = usePageState((state) => state.isPlaying);
  const label = isPlaying ? words.pause : words.play;
  return (
    <IconButton
      kind="tool"
      icon={isPlaying ? "pause" : "play"}
      label={label}
      onClick={() => player.toggle()}
    />
  );
};

/** The shown moment, else how far this drawing has been plotted; null: the end. */
const useMoment = (): number | null => usePageState((state) => state.momentS ?? drawnUntilS(state));

const Scrubber = ({ player, totalS }: { player: Player; totalS: number }) => {
  const momentS = useMoment() ?? totalS;
  return (
    <input
      type="range"
      aria-label={words.scrub}
      aria-valuetext={formatMoment(momentS)}
      min={0}
      max={totalS}
      step={totalS / STEPS}
      value={momentS}
      onChange={(event) => {
        player.pause();
        player.seek(Number(event.target.value));
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
  const store = usePageStore();
  const playRate = usePageState((state) => state.playRate);
  return (
    <label className="tool-select">
      <span className="visually-hidden">{words.rate}</span>
      <select
        value={playRate}
        title={words.rate}
        onChange={(event) => store.setState({ playRate: Number(event.target.value) })}
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
  const { changeView } = useActions();
  return (
    <IconButton
      kind="tool"
      icon="graph"
      label={words.graph}
      aria-pressed={showGraph}
      onClick={() => changeView({ showGraph: !showGraph })}
    />
  );
};
