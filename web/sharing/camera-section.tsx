import { useCallback, useState, type FormEvent } from "react";
import { currentPlotter } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { Select } from "../ui/fields/choice.js";
import { isCameraUrl } from "./camera.js";
import { sharingText as words } from "./text.js";
import { useFetched, useSharing } from "./use-sharing.js";

const EVERY_S = [0, 1, 2, 5, 10, 30, 60] as const;
const KEEP_EVERY_S = [2, 5, 10, 30, 60, 300] as const;

/** The camera's picture on this page, and the pictures that the server keeps. */
export const CameraSection = () => (
  <>
    <ShownCamera />
    <KeptPictures />
  </>
);

interface AddressProps {
  readonly label: string;
  readonly value: string;
  onChange(url: string): void;
}

const CameraAddress = ({ label, value, onChange }: AddressProps) => {
  const isGood = isAddress(value);
  return (
    <>
      <input
        className="text-field"
        type="url"
        maxLength={2_000}
        aria-label={label}
        aria-invalid={!isGood}
        placeholder="http://camera.local:8080/?action=stream"
        value={value}
        onChange={(event) => onChange(event.target.value)}
      />
      {!isGood && <p className="note note-error">{words.cameraBadUrl}</p>}
    </>
  );
};

const isAddress = (url: string): boolean => url.trim() === "" || isCameraUrl(url.trim());

/** Settings of the camera's picture, stored in this browser. */
const ShownCamera = () => {
  const { cameraUrl, cameraEveryS } = usePageState((state) => state.view);
  const { changeView } = useActions();
  const [url, setUrl] = useState(cameraUrl);
  const wanted = url.trim();
  const isGood = isAddress(url);
  return (
    <form
      className="sharing-form"
      onSubmit={(event) => {
        event.preventDefault();
        if (isGood) changeView({ cameraUrl: wanted });
      }}
    >
      <h3>{words.cameraShown}</h3>
      <p className="note">{words.cameraHint}</p>
      <CameraAddress label={words.cameraUrl} value={url} onChange={setUrl} />
      <Select
        label={words.cameraEvery}
        value={String(cameraEveryS)}
        options={EVERY_S.map((s) => ({ value: String(s), label: s === 0 ? words.cameraStream : `${s} s` }))}
        onChange={(s) => changeView({ cameraEveryS: Number(s) })}
      />
      <Button type="submit" disabled={!isGood || wanted === cameraUrl}>
        {wanted === "" && cameraUrl !== "" ? words.cameraOff : words.cameraShow}
      </Button>
    </form>
  );
};

/** The camera that the server reads while the current plotter plots. */
const KeptPictures = () => {
  const plotter = usePageState(currentPlotter);
  const { cameras } = useSharing();
  const id = plotter?.id ?? "";
  const [found, fetchAgain] = useFetched(useCallback(() => cameras.get(id), [cameras, id]));
  const [typed, setTyped] = useState<string | null>(null);
  const [everyS, setEveryS] = useState<number | null>(null);
  const [isTrying, setTrying] = useState(false);
  if (!found || !plotter) return null;
  const { camera, last } = found;
  const url = (typed ?? camera?.url ?? "").trim();
  const every = everyS ?? camera?.everyS ?? 10;
  const isSame = url === (camera?.url ?? "") && (camera === null || every === camera.everyS);
  const save = async (event: FormEvent): Promise<void> => {
    event.preventDefault();
    setTrying(true);
    await (url === "" ? cameras.remove(id) : cameras.set(id, { url, everyS: every }));
    setTrying(false);
    fetchAgain();
  };
  const choices = KEEP_EVERY_S.some((s) => s === every) ? KEEP_EVERY_S : [every, ...KEEP_EVERY_S];
  return (
    <form className="sharing-form" onSubmit={(event) => void save(event)}>
      <h3>{words.picturesOf(plotter.name)}</h3>
      <p className="note">{words.picturesHint}</p>
      <CameraAddress label={words.picturesUrl} value={typed ?? camera?.url ?? ""} onChange={setTyped} />
      <Select
        label={words.picturesEvery}
        value={String(every)}
        options={choices.map((s) => ({ value: String(s), label: `${s} s` }))}
        onChange={(s) => setEveryS(Number(s))}
      />
      <Button type="submit" disabled={isTrying || isSame || !isAddress(url)}>
        {isTrying ? words.picturesTrying : url === "" && camera ? words.picturesOff : words.picturesKeep}
      </Button>
      {camera !== null && last !== null && (
        <p className={last.fault === null ? "note" : "note note-error"} role="status">
          {last.fault ?? words.picturesWork}
        </p>
      )}
    </form>
  );
};
