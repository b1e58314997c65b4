import { wizardText } from "./wizard-text.js";
import { Button } from "../ui/button.js";

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
