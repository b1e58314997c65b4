import { useCallback, useEffect, useRef, useState } from "react";
import { PICTURE_TYPES, pictureKindOf, type Job, type KeptPictures } from "../../src/schema/index.js";
import { useBackend, useIsConnected } from "../state/use-store.js";
import { IconButton } from "../ui/button.js";
import { formatWhen } from "../ui/format.js";
import { watchText as words } from "./text.js";
import "./timelapse.css";

const PICTURES_PER_S = 8;
/** The last picture is taken when the plot is done, and may take that long to arrive. */
const LATE_MS = 12_000;
/** That many pictures are fetched ahead of the one that is shown. */
const AHEAD = 8;
/** How often the list, or a picture, is asked for that does not come. */
const MOST_TRIES = 3;

/** The pictures that the server's camera took of a plot, played quickly. Nothing without a camera. */
export const Timelapse = ({ job }: { job: Job }) => {
  const { pictures, missing } = useKeptPictures(job);
  if (pictures.length > 0)
    return <Player key={job.id} jobId={job.id} pictures={pictures} missing={missing} />;
  if (missing === 0) return null;
  return (
    <section className="timelapse" aria-label={words.timelapse}>
      <p className="note">{words.missingPictures(missing)}</p>
    </section>
  );
};

const useKeptPictures = ({ id, endedAt }: Job): KeptPictures => {
  const { cameras } = useBackend();
  const isConnected = useIsConnected();
  const [kept, setKept] = useState<(KeptPictures & { readonly of: string }) | null>(null);
  useEffect(() => {
    let isCurrent = true;
    let tries = 0;
    let timer: ReturnType<typeof setTimeout> | undefined;
    const isRecent = endedAt !== null && Date.now() - Date.parse(endedAt) < LATE_MS;
    const fetchList = async (): Promise<void> => {
      tries++;
      // A job that is gone has none.
      const found = await cameras.pictures(id).catch(() => null);
      if (!isCurrent) return;
      if (found) setKept({ ...found, of: id });
      const isAgain = found ? isRecent && tries === 1 : tries < MOST_TRIES;
      if (isAgain) timer = setTimeout(() => void fetchList(), LATE_MS);
    };
    void fetchList();
    return () => {
      isCurrent = false;
      clearTimeout(timer);
    };
  }, [cameras, id, endedAt, isConnected]);
  return kept?.of === id ? kept : NO_PICTURES;
};

const NO_PICTURES: KeptPictures = { pictures: [], missing: 0 };

interface PlayerProps extends KeptPictures {
  readonly jobId: string;
}

const Player = ({ jobId, pictures, missing }: PlayerProps) => {
  const last = pictures.length - 1;
  /** Null: the last one. */
  const [chosen, setChosen] = useState<number | null>(null);
  const [isPlaying, setPlaying] = useState(false);
  const { urls, failed, need, drop, tryAgain } = usePictureUrls(jobId);
  const shown = Math.min(chosen ?? last, last);
  const { at } = pictures[shown];
  /** Pictures that can't be had are left out. */
  const next = pictures.findIndex((one, index) => index > shown && !failed.has(one.at));
  const isNextHere = next < 0 || urls[pictures[next].at] !== undefined;
  const missingCount = missing + pictures.filter((one) => failed.has(one.at)).length;
  useEffect(() => {
    for (const one of pictures.slice(shown, shown + AHEAD)) need(one.at);
  }, [pictures, shown, need]);
  useEffect(() => {
    if (!isPlaying || !isNextHere) return;
    const timer = setTimeout(() => {
      if (next >= 0) setChosen(next);
      if (next < 0 || next === last) setPlaying(false);
    }, 1_000 / PICTURES_PER_S);
    return () => clearTimeout(timer);
  }, [isPlaying, isNextHere, next, last]);
  const play = (): void => {
    if (!isPlaying) tryAgain();
    if (!isPlaying && shown >= last) setChosen(0);
    setPlaying(!isPlaying && last > 0);
  };
  const time = formatWhen(at);
  return (
    <section className="timelapse" aria-label={words.timelapse}>
      <div className="timelapse-picture">
        {urls[at] && (
          <img
            src={urls[at]}
            alt={words.pictureAlt(shown + 1, pictures.length, time)}
            onError={() => drop(at)}
          />
        )}
        {failed.has(at) && <p className="note">{words.missingPicture}</p>}
      </div>
      <div className="timelapse-controls">
        <IconButton
          kind="tool"
          icon={isPlaying ? "pause" : "play"}
          label={isPlaying ? words.pauseTimelapse : words.playTimelapse}
          disabled={last === 0}
          onClick={play}
        />
        <input
          type="range"
          aria-label={words.timelapseMoment}
          aria-valuetext={words.pictureAlt(shown + 1, pictures.length, time)}
          min={0}
          max={last}
          value={shown}
          onChange={(event) => {
            setPlaying(false);
            setChosen(Number(event.target.value));
          }}
        />
        <span className="note">{time}</span>
      </div>
      {missingCount > 0 && <p className="note">{words.missingPictures(missingCount)}</p>}
    </section>
  );
};

/** The fetched pictures by their time, those that can't be had, and what fetches one. */
const usePictureUrls = (jobId: string) => {
  const { cameras } = useBackend();
  const [urls, setUrls] = useState<Readonly<Record<string, string>>>({});
  const [failed, setFailed] = useState<ReadonlySet<string>>(new Set());
  /** How often each picture was asked for. */
  const tries = useRef(new Map<string, number>());
  const [round, setRound] = useState(0);
  const pending = useRef(new Set<string>());
  const made = useRef(new Map<string, string>());
  const take = useCallback((at: string, url: string | null): void => {
    setFailed((now) => {
      const others = new Set([...now].filter((other) => other !== at));
      return url === null ? others.add(at) : others;
    });
    setUrls(({ [at]: _old, ...others }) => (url === null ? others : { ...others, [at]: url }));
  }, []);
  /** A picture that could not be had is asked for again with each step, but not for ever. */
  const need = useCallback(
    (at: string): void => {
      const tried = tries.current.get(at) ?? 0;
      if (made.current.has(at) || pending.current.has(at) || tried >= MOST_TRIES) return;
      tries.current.set(at, tried + 1);
      pending.current.add(at);
      const fetched = cameras.picture(jobId, { at }).then((bytes) => {
        const kind = pictureKindOf(new Uint8Array(bytes, 0, Math.min(12, bytes.byteLength)));
        if (kind === null) return null;
        const url = URL.createObjectURL(new Blob([bytes], { type: PICTURE_TYPES[kind] }));
        made.current.set(at, url);
        return url;
      });
      void fetched
        .catch(() => null)
        .then((url) => {
          pending.current.delete(at);
          take(at, url);
        });
    },
    // In a new round all are needed again.
    // oxlint-disable-next-line react-hooks/exhaustive-deps
    [cameras, jobId, take, round],
  );
  /** It has arrived, but can't be shown. */
  const drop = (at: string): void => {
    URL.revokeObjectURL(made.current.get(at) ?? "");
    made.current.delete(at);
    take(at, null);
  };
  const tryAgain = (): void => {
    tries.current.clear();
    setFailed(new Set());
    setRound(round + 1);
  };
  useEffect(() => {
    const { current } = made;
    return () => [...current.values()].forEach((url) => URL.revokeObjectURL(url));
  }, []);
  return { urls, failed, need, drop, tryAgain };
};
