import { useState } from "react";
import { Sheet } from "../ui/dialog.js";
import { sharingText as words } from "./text.js";
import { Segments, Select } from "../ui/fields/choice.js";
import { AccessSection } from "./access-section.js";
import { HooksSection } from "./hooks-section.js";
import { PlottersSection } from "./plotters-section.js";
import { ShareSection } from "./share-section.js";
import { SharedSection } from "./shared-section.js";
import { useActions, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { isCameraUrl } from "./camera.js";
import "./sharing.css";

const EVERY_S = [0, 1, 2, 5, 10, 30, 60] as const;

/** Settings of the camera's picture, stored in this browser. */
const CameraSection = () => {
  const { cameraUrl, cameraEveryS } = usePageState((state) => state.view);
  const { changeView } = useActions();
  const [url, setUrl] = useState(cameraUrl);
  const wanted = url.trim();
  const isGood = wanted === "" || isCameraUrl(wanted);
  return (
    <form
      className="sharing-form"
      onSubmit={(event) => {
        event.preventDefault();
        if (isGood) changeView({ cameraUrl: wanted });
      }}
    >
      <p className="note">{words.cameraHint}</p>
      <input
        className="text-field"
        type="url"
        maxLength={2_000}
        aria-label={words.cameraUrl}
        aria-invalid={!isGood}
        placeholder="http://camera.local:8080/?action=stream"
        value={url}
        onChange={(event) => setUrl(event.target.value)}
      />
      {!isGood && <p className="note note-error">{words.cameraBadUrl}</p>}
      <Select
        label={words.cameraEvery}
        value={String(cameraEveryS)}
        options={EVERY_S.map((s) => ({ value: String(s), label: s === 0 ? words.cameraStream : `${s} s` }))}
        onChange={(s) => changeView({ cameraEveryS: Number(s) })}
      />
      <Button type="submit" disabled={!isGood || wanted === cameraUrl}>
        {wanted === "" ? words.cameraOff : words.cameraShow}
      </Button>
    </form>
  );
};

const SECTIONS = {
  share: ShareSection,
  access: AccessSection,
  plotters: PlottersSection,
  shared: SharedSection,
  hooks: HooksSection,
  camera: CameraSection,
} as const;
type SectionName = keyof typeof SECTIONS;
const NAMES = Object.keys(SECTIONS) as readonly SectionName[];

/** The dialog for sharing, access, plotters, the shared queue, webhooks and the camera. */
export const SharingDialog = () => {
  const [name, setName] = useState<SectionName>("share");
  const Section = SECTIONS[name];
  return (
    <Sheet title={words.title}>
      <Segments<SectionName>
        label={words.title}
        isLabelHidden
        value={name}
        options={NAMES.map((one) => ({ value: one, label: words.sections[one] }))}
        onChange={setName}
      />
      <Section />
    </Sheet>
  );
};
