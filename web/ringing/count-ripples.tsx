import { useEffect, useId, useState } from "react";
import type { MachineProfile } from "../../src/index.js";
import {
  DAMPINGS,
  findMachine,
  frequenciesOf,
  RINGING_SHEET_MM,
  SPRINGS_TABLE,
  type Axis,
  type Frequencies,
  type RippleReadings,
  type Springs,
} from "../../src/internal.js";
import { activeJob } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { ringingText as words } from "./ringing-text.js";
import { Button } from "../ui/button.js";
import { formatNumber } from "../ui/format.js";
import { CountAxis, NO_READING, readingOf, type Reading } from "./count-axis.js";
import type { Gain, GainRequest } from "./ringing-gain.js";
import { sheetJob } from "./ringing-job.js";
import { FadingPicture } from "./ripple-picture.js";
import { StripPicture } from "./strip-picture.js";
import { isStored, useStoreSprings } from "./use-store-springs.js";
import { useSprings } from "../motion/use-springs.js";

/** Shown until the lines are read. */
const EXAMPLE = { x: 15, y: 25 };
const NEITHER: Frequencies = { x: null, y: null };

/** The first sheet: plot it, count the ripples, store the result. */
export const CountRipples = () => {
  const known = useSprings();
  const [readings, setReadings] = useState<Record<Axis, Reading>>({ x: NO_READING, y: NO_READING });
  const [damping, setDamping] = useState(known?.damping ?? SPRINGS_TABLE.damping.default);
  const read = { x: readingOf(readings.x), y: readingOf(readings.y) };
  const x = frequenciesOrFault({ x: read.x, y: null }, damping);
  const y = frequenciesOrFault({ x: null, y: read.y }, damping);
  const isFaulty = x.fault !== null || y.fault !== null;
  const { hz } = isFaulty ? { hz: { x: x.hz.x, y: y.hz.y } } : frequenciesOrFault(read, damping);
  const shown: Springs = { xHz: hz.x ?? EXAMPLE.x, yHz: hz.y ?? EXAMPLE.y, damping };
  const springs = hz.x === null || hz.y === null ? null : shown;
  return (
    <>
      <div className="ringing-sheet">
        <StripPicture />
        <PlotSheet />
      </div>
      <section className="ringing-count">
        <h3>{words.countTitle}</h3>
        <p className="note">{words.countHint}</p>
        <div className="count-axes">
          {(["y", "x"] as const).map((axis) => (
            <CountAxis
              key={axis}
              axis={axis}
              reading={readings[axis]}
              springs={shown}
              hz={hz[axis]}
              fault={(axis === "x" ? x : y).fault}
              onChange={(reading) => setReadings({ ...readings, [axis]: reading })}
            />
          ))}
        </div>
      </section>
      <DampingChoice springs={shown} onChange={setDamping} />
      {springs && <Gains springs={springs} />}
      <StoreButton springs={springs} />
    </>
  );
};

const PlotSheet = () => {
  const settings = usePageState((state) => state.settings);
  const isPlotting = usePageState((state) => activeJob(state)?.name === words.jobName);
  const { plotJob } = useActions();
  const job = sheetJob(settings, words.jobName);
  const { width, height } = RINGING_SHEET_MM;
  return (
    <section>
      <h3>{words.plotTitle}</h3>
      <p className="note">{words.plotHint(width, height)}</p>
      <Button kind="primary" disabled={job === null || isPlotting} onClick={() => job && void plotJob(job)}>
        {isPlotting ? words.plotting : words.plot}
      </Button>
      {job === null && <p className="note note-error">{words.noRoom(width, height)}</p>}
    </section>
  );
};

interface DampingChoiceProps {
  readonly springs: Springs;
  onChange(damping: number): void;
}

/** Pictures of the line for y with its measured frequency, fading more and less quickly. */
const DampingChoice = ({ springs, onChange }: DampingChoiceProps) => {
  const name = useId();
  return (
    <fieldset className="damping">
      <legend>{words.dampingTitle}</legend>
      <p className="note">{words.dampingHint}</p>
      <div className="damping-pictures">
        {DAMPINGS.map((damping, i) => (
          <label key={damping} className="damping-picture">
            <FadingPicture axis="y" springs={{ ...springs, damping }} />
            <span>
              <input
                type="radio"
                name={name}
                checked={damping === springs.damping}
                onChange={() => onChange(damping)}
              />
              {words.dampings[i]}
            </span>
          </label>
        ))}
      </div>
    </fieldset>
  );
};

const StoreButton = ({ springs }: { springs: Springs | null }) => {
  const store = useStoreSprings();
  const known = useSprings();
  return (
    <div className="button-row">
      <Button
        kind="primary"
        disabled={springs === null || isStored(springs, known)}
        onClick={() => springs && void store(springs)}
      >
        {words.save}
      </Button>
      {known && (
        <p className="note" role="status">
          {words.saved(formatNumber(known.xHz, 1), formatNumber(known.yHz, 1))}
        </p>
      )}
    </div>
  );
};

const Gains = ({ springs }: { springs: Springs }) => {
  const machine = usePageState(({ settings }) => findMachine(settings));
  const gains = useGains(machine, springs);
  const beforeS = gains[0]?.drawS ?? 1;
  const heads = words.gainHeads;
  return (
    <section>
      <h3>{words.gainTitle}</h3>
      <p className="note">{words.gainHint}</p>
      <table className="gain-table">
        <thead>
          <tr>
            <th scope="col">{heads.quality}</th>
            <th scope="col">{heads.time}</th>
            <th scope="col">{heads.off}</th>
          </tr>
        </thead>
        <tbody>
          {gains.map(({ quality, drawS, maxMm }) => (
            <tr key={quality}>
              <th scope="row">{words.gainNames[quality]}</th>
              <td>{words.seconds(formatNumber(drawS, 1), changeOf(drawS / beforeS))}</td>
              <td>{formatNumber(maxMm, 2)} mm</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
};

/** Empty until they are planned. */
const useGains = (machine: MachineProfile | null, { xHz, yHz, damping }: Springs): readonly Gain[] => {
  const [gains, setGains] = useState<readonly Gain[]>([]);
  useEffect(() => {
    if (!machine) return;
    const worker = new Worker(new URL("./gain.worker.ts", import.meta.url), { type: "module" });
    worker.onmessage = ({ data }: MessageEvent<readonly Gain[]>) => {
      setGains(data);
      worker.terminate();
    };
    const request: GainRequest = { machine, springs: { xHz, yHz, damping } };
    worker.postMessage(request);
    return () => worker.terminate();
  }, [machine, xHz, yHz, damping]);
  return gains;
};

/** "−38 %"; empty for no change. */
const changeOf = (share: number): string => {
  const percent = Math.round(100 * (share - 1));
  return percent === 0 ? "" : `${percent < 0 ? "−" : "+"}${Math.abs(percent)} %`;
};

const frequenciesOrFault = (
  readings: RippleReadings,
  damping: number,
): { hz: Frequencies; fault: string | null } => {
  try {
    return { hz: frequenciesOf(readings, damping), fault: null };
  } catch (error) {
    return { hz: NEITHER, fault: error instanceof Error ? error.message : String(error) };
  }
};
