import type { MachineProfile } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";

/** Props of each step. `onNext` gets the profile with the step's changes. */
export interface StepProps {
  readonly profile: MachineProfile;
  /** The page's settings with another profile, for moves by hand. */
  settingsWith(profile: MachineProfile): PlotSettings;
  onNext(profile: MachineProfile): void;
}
