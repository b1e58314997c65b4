import { useState } from "react";
import { Sheet } from "../ui/dialog.js";
import { sharingText as words } from "./text.js";
import { Segments } from "../ui/fields/choice.js";
import { AccessSection } from "./access-section.js";
import { CameraSection } from "./camera-section.js";
import { HooksSection } from "./hooks-section.js";
import { PlottersSection } from "./plotters-section.js";
import { ShareSection } from "./share-section.js";
import { SharedSection } from "./shared-section.js";
import "./sharing.css";

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
