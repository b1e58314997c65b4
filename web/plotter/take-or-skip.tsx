import { wizardText } from "./wizard-text.js";

interface TakeOrSkipProps {
  readonly label: string;
  readonly isOff: boolean;
  onTake(): void;
  onSkip(): void;
}

/** The buttons at the end of an optional step of the wizard. */
export const TakeOrSkip = ({ label, isOff, onTake, onSkip }: TakeOrSkipProps) => (
  <div className="button-row">
    <button type="button" className="button button-primary" disabled={isOff} onClick={onTake}>
      {label}
    </button>
    <button type="button" className="button" onClick={onSkip}>
      {wizardText.skip}
    </button>
  </div>
);
