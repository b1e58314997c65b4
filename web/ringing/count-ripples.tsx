import { useEffect, useState } from "react";
import type { MachineProfile } from "../../src/index.js";
import {
  findMachine,
  NEXT_STAIRS_MM,
  RINGING_SPEEDS,
  SPRINGS_TABLE,
  STAIRS_MM,
  type Springs,
} from "../../src/internal.js";
import { activeJob } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { ringingText as words } from "./ringing-text.js";
import { Button } from "../ui/button.js";
import { Segments } from "../ui/fields/choice.js";
import { formatNumber } from "../ui/format.js";
import { CountAxis, frequencyOf, NO_READING, type Reading } from "./count-axis.js";
import type { Gain, GainRequest } from "./ringing-gain.js";
import { sheetJob } from "./ringing-job.js";
import { SheetPicture } from "./sheet-picture.js";
import { isStored, useStoreSprings } from "./use-store-springs.js";
import { useSprings } from "../motion/use-springs.js";

const SHEET_MM = STAIRS_MM + (RINGING_SPEEDS.length - 1) * NEXT_STAIRS_MM;
const LABELS = RINGING_SPEEDS.map((speed) => words.speedLabel(formatNumber(speed, 0)));

/** The first sheet: plot it, count the ripples, store the result. */
export const CountRipples = () => {
  const [line, setLine] = useState(1);
  const [x, setX] = useState<Reading>(NO_READING);
  const [y, setY] = useState<Reading>(NO_READING);
  const known = useSprings();
  const springs = springsOf(x, y, RINGING_SPEEDS[line], known?.damping ?? SPRINGS_TABLE.damping.default);
  return (
    <>
      <div className="ringing-sheet">
        <SheetPicture labels={LABELS} nextMm={NEXT_STAIRS_MM} chosen={line} onChoose={setLine} />
        <PlotSheet />
      </div>
      <section className="ringing-count">
        <h3>{words.countTitle}</h3>
        <p className="note">{words.countHint}</p>
        <Segments
          label={words.line}
          value={String(line)}
          options={LABELS.map((label, i) => ({ value: String(i), label }))}
          onChange={(index) => setLine(Number(index))}
        />
        <div className="count-axes">
          <CountAxis axis="x" reading={x} line={line} onChange={setX} />
          <CountAxis axis="y" reading={y} line={line} onChange={setY} />
        </div>
      </section>
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
  return (
    <section>
      <h3>{words.plotTitle}</h3>
      <p className="note">{words.plotHint(SHEET_MM)}</p>
      <Button kind="primary" disabled={job === null || isPlotting} onClick={() => job && void plotJob(job)}>
        {isPlotting ? words.plotting : words.plot}
      </Button>
      {job === null && <p className="note note-error">{words.noRoom(SHEET_MM)}</p>}
    </section>
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

/** Null until both axes are read and have possible frequencies. */
const springsOf = (x: Reading, y: Reading, speedMmPerS: number, damping: number): Springs | null => {
  const [xHz, yHz] = [x, y].map((reading) => {
    try {
      return frequencyOf(reading, speedMmPerS);
    } catch {
      return null;
    }
  });
  return xHz === null || yHz === null ? null : { xHz, yHz, damping };
};
