import type { MachineProfile } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";

/** What each step is given; `onNext` takes the profile as the step leaves it. */
export interface StepProps {
  readonly profile: MachineProfile;
  /** The page's settings with another profile in them: what moves by hand are asked for with. */
  settingsWith(profile: MachineProfile): PlotSettings;
  onNext(profile: MachineProfile): void;
}
