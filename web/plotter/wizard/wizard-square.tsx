import { useState } from "react";
import type { MachineProfile } from "../../../src/index.js";
import { stepsPerMmMeasured } from "../../../src/internal.js";
import { useActions } from "../../state/use-store.js";
import { wizardText as words } from "./text.js";
import { Button } from "../../ui/button.js";
import { formatNumber } from "../../ui/format.js";
import { MmPair } from "../../ui/fields/number-field.js";
import { TakeOrSkip, type StepProps } from "./wizard-step.js";

const SQUARE_MM = 100;

/** A square is drawn and measured with a ruler. Its real size gives the steps per mm. */
export const SquareStep = ({ profile, onNext }: StepProps) => {
  const { moveByHand } = useActions();
  const sizeMm = Math.min(SQUARE_MM, Math.floor(Math.min(profile.widthMm, profile.heightMm) / 2));
  const [[xMm, yMm], setSides] = useState<readonly [number, number]>([sizeMm, sizeMm]);
  const measured = measuredOr(profile, sizeMm, xMm, yMm);
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
      {typeof measured === "string" ? (
        <p className="note note-error" role="alert">
          {measured}
        </p>
      ) : (
        <p className="note">{words.stepsPerMm(formatNumber(measured, 3))}</p>
      )}
      <TakeOrSkip
        label={words.take}
        isOff={typeof measured === "string"}
        onTake={() => {
          if (typeof measured === "number") onNext({ ...profile, stepsPerMm: Number(measured.toFixed(4)) });
        }}
        onSkip={() => onNext(profile)}
      />
    </>
  );
};

/** Steps per mm, or what is wrong with the measurement. */
const measuredOr = (profile: MachineProfile, sizeMm: number, xMm: number, yMm: number): number | string => {
  try {
    return stepsPerMmMeasured(profile, sizeMm, xMm, yMm);
  } catch (error) {
    return error instanceof Error ? error.message : String(error);
  }
};
