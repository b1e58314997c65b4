/** The legend of the view mode "Time": where the minutes go, and changes that would save some of them. */
import { useEffect, useState } from "react";
import { timesByLayer, withQuality, findMachine } from "../../../src/internal.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { SLOWEST_TIMES } from "../../scene/scene.js";
import { boardFirmware, type PageStore } from "../../state/store.js";
import { useActions, usePageState, usePageStore } from "../../state/use-store.js";
import { Button } from "../../ui/button.js";
import { formatDuration, formatNumber } from "../../ui/format.js";
import { openPlanner } from "../../worker/planner.js";
import type { Planned } from "../../worker/protocol.js";
import { Ramp } from "./legend.js";
import "./time-legend.css";

const JOIN_MM = 0.3;
const REPEATS_MM = 0.1;

const words = {
  legend: "Where the time goes",
  title: "Time for each mm",
  scale: (leastMs: string, mostMs: string) => [`${leastMs} ms`, `${mostMs} ms or more`],
  parts: { drawS: "is drawing", travelS: "is moving with the pen up", penS: "is lifting" },
  share: (percent: string, what: string, time: string) => `${percent} % ${what}: ${time}`,
  saves: (what: string, time: string) => `${what} saves ${time}.`,
  saved: (what: string) => `${what}: done.`,
  searching: "Looking for what would save time…",
  nothing: "No setting would save much.",
  tryIt: "Try",
  undo: "Undo",
  changes: {
    join: `Joining gaps below ${formatNumber(JOIN_MM, 1)} mm`,
    repeats: "Leaving out lines that are drawn twice",
    fast: "Quality “fast”",
    order: "Order of strokes “Fastest”",
  },
};

type ChangeName = keyof typeof words.changes;

interface Change {
  readonly name: ChangeName;
  readonly settings: PlotSettings;
}

/** Settings with one change; null: they have it, or it does not apply. Cheap ones first. */
const CHANGES: Readonly<Record<ChangeName, (settings: PlotSettings) => PlotSettings | null>> = {
  join: (settings) => (settings.prepare.joinMm >= JOIN_MM ? null : withLines(settings, { joinMm: JOIN_MM })),
  repeats: (settings) =>
    settings.prepare.dropRepeatsMm > 0 ? null : withLines(settings, { dropRepeatsMm: REPEATS_MM }),
  fast: (settings) => {
    const springs = findMachine(settings)?.springs ?? null;
    return springs && { ...settings, motion: withQuality(settings.motion, "fast", springs) };
  },
  order: (settings) => (settings.prepare.order === "best" ? null : withLines(settings, { order: "best" })),
};

const NAMES = Object.keys(CHANGES) as ChangeName[];

const changesOf = (settings: PlotSettings): readonly Change[] =>
  NAMES.flatMap((name) => {
    const changed = CHANGES[name](settings);
    return changed ? [{ name, settings: changed }] : [];
  });

const withLines = (settings: PlotSettings, change: Partial<PlotSettings["prepare"]>): PlotSettings => ({
  ...settings,
  prepare: { ...settings.prepare, ...change },
});

/** The parts of `settings` that a change concerns, as `before` has them. */
const undone = (name: ChangeName, settings: PlotSettings, before: PlotSettings): PlotSettings => {
  if (name === "fast") return { ...settings, motion: before.motion };
  const { joinMm, dropRepeatsMm, order } = before.prepare;
  return withLines(settings, { join: { joinMm }, repeats: { dropRepeatsMm }, order: { order } }[name]);
};

/** Less is not worth a change: s, and share of the plot. */
const WORTH_S = 2;
const WORTH_SHARE = 0.01;

export const TimeLegend = ({ planned }: { planned: Planned }) => {
  const { layers, home } = timesByLayer(planned.trajectory, new Uint16Array(planned.strokeCount));
  const sum = (kind: "drawS" | "travelS" | "penS"): number =>
    layers.reduce((total, layer) => total + layer[kind], home[kind]);
  const parts = (["drawS", "travelS", "penS"] as const).map((kind) => ({ kind, s: sum(kind) }));
  const { totalS } = planned.trajectory;
  const leastMs = 1_000 / planned.scene.topDrawMmPerS;
  return (
    <figure className="legend legend-rows time-legend" aria-label={words.legend}>
      <div className="time-shares">
        <div className="time-bar" aria-hidden="true">
          {parts.map(({ kind, s }) => (
            <span key={kind} data-kind={kind} style={{ flexGrow: s }} />
          ))}
        </div>
        {/* On a phone it is one line, which scrolls. */}
        <ul tabIndex={0}>
          {parts.map(({ kind, s }) => (
            <li key={kind} data-kind={kind}>
              {words.share(formatNumber((100 * s) / totalS, 0), words.parts[kind], formatDuration(s))}
            </li>
          ))}
        </ul>
      </div>
      <div className="time-scale">
        <Ramp
          title={words.title}
          labels={words.scale(formatNumber(leastMs, 0), formatNumber(leastMs * SLOWEST_TIMES, 0))}
        />
      </div>
      <Suggestions key={planned.drawingKey} planned={planned} />
    </figure>
  );
};

const Suggestions = ({ planned }: { planned: Planned }) => {
  const store = usePageStore();
  const { changeSettings } = useActions();
  const isPlanning = usePageState((state) => state.isPlanning);
  const [found, setFound] = useState<Savings | null>(null);
  const [tried, setTried] = useState<Partial<Record<ChangeName, PlotSettings>>>({});
  useEffect(
    () => (isPlanning ? undefined : findSavings(store, planned, setFound)),
    [store, planned, isPlanning],
  );
  const savesS = found?.of === planned ? found.savesS : {};
  const isDone = found?.of === planned ? found.isDone : changesOf(planned.settings).length === 0;
  const offered = NAMES.filter((name) => savesS[name] !== undefined && !tried[name]);
  const use = (name: ChangeName): void => {
    const { settings } = store.getState();
    setTried({ ...tried, [name]: settings });
    changeSettings(`save time: ${name}`, (now) => CHANGES[name](now) ?? now);
  };
  const takeBack = (name: ChangeName, before: PlotSettings): void => {
    setTried({ ...tried, [name]: undefined });
    changeSettings(`save time: not ${name}`, (now) => undone(name, now, before));
  };
  return (
    <ul className="time-changes">
      {NAMES.map((name) => {
        const before = tried[name];
        return before ? (
          <li key={name}>
            {words.saved(words.changes[name])}{" "}
            <Button kind="link" onClick={() => takeBack(name, before)}>
              {words.undo}
            </Button>
          </li>
        ) : null;
      })}
      {offered.map((name) => (
        <li key={name}>
          {words.saves(words.changes[name], formatDuration(savesS[name] ?? 0))}{" "}
          <Button kind="link" onClick={() => use(name)}>
            {words.tryIt}
          </Button>
        </li>
      ))}
      {!isDone && (
        <li>
          <span role="status">{words.searching}</span>
        </li>
      )}
      {isDone && offered.length === 0 && <li>{words.nothing}</li>}
    </ul>
  );
};

interface Savings {
  readonly of: Planned;
  readonly isDone: boolean;
  /** s that each change saves, if it is worth it. */
  readonly savesS: Partial<Record<ChangeName, number>>;
}

/** Plans the drawing with each change, one after the other, in a worker of its own. Returns a function that stops it. */
function findSavings(store: PageStore, planned: Planned, found: (savings: Savings) => void): () => void {
  const state = store.getState();
  const { drawing, settings } = state;
  if (drawing?.key !== planned.drawingKey) return () => undefined;
  const firmware = boardFirmware(state);
  const left = [...changesOf(settings)];
  if (left.length === 0) return () => undefined;
  let savesS: Savings["savesS"] = {};
  const worthS = Math.max(WORTH_S, WORTH_SHARE * planned.trajectory.totalS);
  const next = (savedS: number): void => {
    const done = left.shift();
    if (done && savedS >= worthS) savesS = { ...savesS, [done.name]: savedS };
    found({ of: planned, isDone: left.length === 0, savesS });
    if (left.length > 0) planner.request({ drawing, settings: left[0].settings, firmware });
    else planner.close();
  };
  const planner = openPlanner({
    onPlanned: ({ trajectory }) => next(planned.trajectory.totalS - trajectory.totalS),
    // A change that can't be planned is not offered.
    onFault: () => next(0),
    onImported: () => undefined,
    onExported: () => undefined,
    onExportFailed: () => undefined,
  });
  planner.request({ drawing, settings: left[0].settings, firmware });
  return () => planner.close();
}
