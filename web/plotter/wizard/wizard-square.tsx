import { useState } from "react";
import type { MachineProfile } from "../../../src/index.js";
import { controllerOf, scaleMeasured, stepsPerMmMeasured } from "../../../src/internal.js";
import { useActions } from "../../state/use-store.js";
import { wizardText as words } from "./text.js";
import { Button } from "../../ui/button.js";
import { formatNumber } from "../../ui/format.js";
import { MmPair } from "../../ui/fields/number-field.js";
import { TakeOrSkip, type StepProps } from "./wizard-step.js";

const SQUARE_MM = 100;

/** A square is drawn and measured with a ruler. Its real size gives the steps per mm, or what to change in the controller. */
export const SquareStep = ({ profile, onNext }: StepProps) => {
  const { moveByHand } = useActions();
  const sizeMm = Math.min(SQUARE_MM, Math.floor(Math.min(profile.widthMm, profile.heightMm) / 2));
  const [[xMm, yMm], setSides] = useState<readonly [number, number]>([sizeMm, sizeMm]);
  const { note, isFault, corrected } = measuredOr(profile, sizeMm, xMm, yMm);
  return (
    <>
      <p>{words.squareHint(sizeMm)}</p>
      <Button kind="primary" onClick={() => void moveByHand({ kind: "square", sizeMm }, profile)}>
        {words.drawSquare}
      </Button>
      <MmPair
        labels={[words.measuredX, words.measuredY]}
        values={[xMm, yMm]}
        min={1}
        step={0.5}
        onChange={(x, y) => setSides([x, y])}
      />
      <p className={isFault ? "note note-error" : "note"} role={isFault ? "alert" : "status"}>
        {note}
      </p>
      {corrected === null ? (
        <Button kind="primary" disabled={isFault} onClick={() => onNext(profile)}>
          {words.next}
        </Button>
      ) : (
        <TakeOrSkip
          label={words.take}
          isOff={isFault}
          onTake={() => onNext(corrected)}
          onSkip={() => onNext(profile)}
        />
      )}
    </>
  );
};

interface SquareResult {
  readonly note: string;
  /** The measurement can't be right. */
  readonly isFault: boolean;
  /** Null: the controller has the scale, not the profile. */
  readonly corrected: MachineProfile | null;
}

/** What follows from the measurement. */
const measuredOr = (profile: MachineProfile, sizeMm: number, xMm: number, yMm: number): SquareResult => {
  const { scaleSettings } = controllerOf(profile);
  try {
    if (scaleSettings) {
      const factors = scaleMeasured(profile, sizeMm, xMm, yMm);
      const wrong = scaleSettings.flatMap((setting, axis) =>
        factors[axis] === 1 ? [] : [words.multiply(setting, factors[axis].toFixed(4))],
      );
      const note = wrong.length === 0 ? words.rightSize : words.scale(wrong, scaleSettings[0]);
      return { note, isFault: false, corrected: null };
    }
    const stepsPerMm = Number(stepsPerMmMeasured(profile, sizeMm, xMm, yMm).toFixed(4));
    const note = words.stepsPerMm(formatNumber(stepsPerMm, 3));
    return { note, isFault: false, corrected: { ...profile, stepsPerMm } };
  } catch (error) {
    const note = error instanceof Error ? error.message : String(error);
    return { note, isFault: true, corrected: scaleSettings ? null : profile };
  }
};
