import { useCallback, useEffect, useRef, useState } from "react";
import { PICTURE_TYPES, pictureKindOf, type Job, type KeptPicture } from "../../src/schema/index.js";
import { useBackend } from "../state/use-store.js";
import { IconButton } from "../ui/button.js";
import { formatWhen } from "../ui/format.js";
import { watchText as words } from "./text.js";
import "./timelapse.css";

const PICTURES_PER_S = 8;
/** The last picture is taken when the plot is done, and may take that long to arrive. */
const LATE_MS = 12_000;
/** That many pictures are fetched ahead of the one that is shown. */
const AHEAD = 8;

/** The pictures that the server's camera took of a plot, played quickly. Nothing without a camera. */
export const Timelapse = ({ job }: { job: Job }) => {
  const pictures = useKeptPictures(job);
  if (pictures.length === 0) return null;
  return <Player key={job.id} jobId={job.id} pictures={pictures} />;
};

const useKeptPictures = ({ id, endedAt }: Job): readonly KeptPicture[] => {
  const { cameras } = useBackend();
  const [kept, setKept] = useState<{ readonly of: string; readonly pictures: readonly KeptPicture[] } | null>(
    null,
  );
  useEffect(() => {
    let isCurrent = true;
    const fetchList = (): void =>
      void cameras.pictures(id).then(
        ({ pictures }) => isCurrent && setKept({ of: id, pictures }),
        // The job is gone, or the server: then there is nothing to show.
        () => undefined,
      );
    fetchList();
    const isRecent = endedAt !== null && Date.now() - Date.parse(endedAt) < LATE_MS;
    const timer = isRecent ? setTimeout(fetchList, LATE_MS) : undefined;
    return () => {
      isCurrent = false;
      clearTimeout(timer);
    };
  }, [cameras, id, endedAt]);
  return kept?.of === id ? kept.pictures : [];
};

interface PlayerProps {
  readonly jobId: string;
  readonly pictures: readonly KeptPicture[];
}

const Player = ({ jobId, pictures }: PlayerProps) => {
  const last = pictures.length - 1;
  /** Null: the last one. */
  const [chosen, setChosen] = useState<number | null>(null);
  const [isPlaying, setPlaying] = useState(false);
  const [urls, need] = usePictureUrls(jobId);
  const shown = Math.min(chosen ?? last, last);
  const { at } = pictures[shown];
  const isNextHere = urls[pictures[Math.min(shown + 1, last)].at] !== undefined;
  useEffect(() => {
    for (const one of pictures.slice(shown, shown + AHEAD)) need(one.at);
  }, [pictures, shown, need]);
  useEffect(() => {
    if (!isPlaying || !isNextHere) return;
    const timer = setTimeout(() => {
      setChosen(shown + 1);
      if (shown + 1 >= last) setPlaying(false);
    }, 1_000 / PICTURES_PER_S);
    return () => clearTimeout(timer);
  }, [isPlaying, isNextHere, shown, last]);
  const play = (): void => {
    if (!isPlaying && shown >= last) setChosen(0);
    setPlaying(!isPlaying && last > 0);
  };
  const time = formatWhen(at);
  return (
    <section className="timelapse" aria-label={words.timelapse}>
      <div className="timelapse-picture">
        {urls[at] && <img src={urls[at]} alt={words.pictureAlt(shown + 1, pictures.length, time)} />}
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
    </section>
  );
};

/** The fetched pictures by their time, and a function that fetches one. */
const usePictureUrls = (jobId: string): readonly [Readonly<Record<string, string>>, (at: string) => void] => {
  const { cameras } = useBackend();
  const [urls, setUrls] = useState<Readonly<Record<string, string>>>({});
  const asked = useRef(new Set<string>());
  const made = useRef<string[]>([]);
  const need = useCallback(
    (at: string): void => {
      if (asked.current.has(at)) return;
      asked.current.add(at);
      cameras.picture(jobId, { at }).then(
        (bytes) => {
          const kind = pictureKindOf(new Uint8Array(bytes, 0, Math.min(12, bytes.byteLength)));
          const url = URL.createObjectURL(new Blob([bytes], { type: kind ? PICTURE_TYPES[kind] : "" }));
          made.current.push(url);
          setUrls((now) => ({ ...now, [at]: url }));
        },
        () => asked.current.delete(at),
      );
    },
    [cameras, jobId],
  );
  useEffect(() => {
    const { current } = made;
    return () => current.forEach((url) => URL.revokeObjectURL(url));
  }, []);
  return [urls, need];
};
