import type { MachineProfile } from "../../../src/index.js";
import { Button } from "../../ui/button.js";
import { wizardText } from "./text.js";

/** Props of each step. `onNext` gets the profile with the step's changes. */
export interface StepProps {
  readonly profile: MachineProfile;
  onNext(profile: MachineProfile): void;
}

interface TakeOrSkipProps {
  readonly label: string;
  readonly isOff: boolean;
  onTake(): void;
  onSkip(): void;
}

/** The buttons at the end of an optional step of the wizard. */
export const TakeOrSkip = ({ label, isOff, onTake, onSkip }: TakeOrSkipProps) => (
  <div className="button-row">
    <Button kind="primary" disabled={isOff} onClick={onTake}>
      {label}
    </Button>
    <Button onClick={onSkip}>{wizardText.skip}</Button>
  </div>
);
