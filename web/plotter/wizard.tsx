import { useState } from "react";
import { MACHINES, type MachineProfile } from "../../src/index.js";
import { findMachine } from "../../src/internal.js";
import { Button } from "../ui/button.js";
import { Sheet } from "../ui/sheet.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import { wizardText as words } from "./wizard-text.js";
import { copyOf } from "./profile.js";
import { DirectionStep } from "./wizard-direction.js";
import { NameStep } from "./wizard-name.js";
import { PlotterStep } from "./wizard-plotter.js";
import { ServoStep } from "./wizard-servo.js";
import { SquareStep } from "./wizard-square.js";
import "./machines.css";

const STEPS = [PlotterStep, DirectionStep, SquareStep, ServoStep, NameStep] as const;

/** Makes a profile for an unknown plotter from what the user sees it do. */
export const Wizard = () => {
  const store = usePageStore();
  const { closeDialog } = useActions();
  const made = usePageState((state) => state.machines);
  const [index, setIndex] = useState(0);
  const [profile, setProfile] = useState<MachineProfile>(() =>
    copyOf(findMachine(store.getState().settings) ?? MACHINES[0], words.firstName, made),
  );
  const Step = STEPS[index];
  const onNext = (next: MachineProfile): void => {
    setProfile(next);
    if (index === STEPS.length - 1) closeDialog();
    else setIndex(index + 1);
  };
  return (
    <Sheet title={words.title}>
      <ol className="wizard-steps" aria-label={words.steps}>
        {words.stepNames.map((name, at) => (
          <li key={name} aria-current={at === index ? "step" : undefined} data-done={at < index || undefined}>
            {name}
          </li>
        ))}
      </ol>
      <div className="wizard-step">
        <Step key={index} profile={profile} onNext={onNext} />
      </div>
      {index > 0 && (
        <Button kind="link" onClick={() => setIndex(index - 1)}>
          {words.back}
        </Button>
      )}
    </Sheet>
  );
};
