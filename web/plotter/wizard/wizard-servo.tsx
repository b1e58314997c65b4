import { useId, useMemo, useState } from "react";
import { useActions } from "../../state/use-store.js";
import { ChoiceFields } from "../machines/controller-fields.js";
import { isEbbMachine, problemsOf, withController, type EbbProfile } from "../machines/profile.js";
import { wizardText as words } from "./text.js";
import { ServoPin } from "../machines/profile-form.js";
import { servoFollower } from "../hand/servo-follow.js";
import { Button } from "../../ui/button.js";
import { TakeOrSkip, type StepProps } from "./wizard-step.js";

/** In 1/12 µs: servos accept pulses of about 0.4 to 2.6 ms. */
const RANGE = { min: 5_000, max: 31_000, step: 100 } as const;

export const ServoStep = ({ profile, ...props }: StepProps) =>
  isEbbMachine(profile) ? (
    <EbbServoStep profile={profile} {...props} />
  ) : (
    <PenLiftStep profile={profile} {...props} />
  );

/** The fields of the controller's profile that lift the pen. */
const PenLiftStep = ({ profile, onNext }: StepProps) => {
  const { moveByHand } = useActions();
  const [draft, setDraft] = useState(profile);
  const problems = problemsOf(draft);
  return (
    <>
      <p>{words.liftHint}</p>
      <ChoiceFields profile={draft} onChange={setDraft} />
      {problems.length > 0 && (
        <p className="note note-error" role="alert">
          {problems.join("; ")}
        </p>
      )}
      <Button disabled={problems.length > 0} onClick={() => void moveByHand({ kind: "cycle-pen" }, draft)}>
        {words.tryPen}
      </Button>
      <TakeOrSkip
        label={words.next}
        isOff={problems.length > 0}
        onTake={() => onNext(draft)}
        onSkip={() => onNext(profile)}
      />
    </>
  );
};

/** The pen follows two sliders, which set the ends of the servo's range. */
const EbbServoStep = ({ profile, onNext }: StepProps & { readonly profile: EbbProfile }) => {
  const { moveByHand } = useActions();
  const [draft, setDraft] = useState(profile);
  const follow = useMemo(
    () =>
      servoFollower((to: { pos: number; profile: EbbProfile }) =>
        moveByHand({ kind: "servo", pos: to.pos }, to.profile),
      ),
    [moveByHand],
  );
  const take = (which: "servoPosAt0Pct" | "servoPosAt100Pct", pos: number): void => {
    setDraft(withController(draft, { [which]: pos }));
    follow({ pos, profile: draft });
  };
  return (
    <>
      <p>{words.servoHint}</p>
      <ServoPin profile={draft} onChange={setDraft} />
      <ServoSlider
        label={words.highest}
        value={draft.controller.servoPosAt100Pct}
        onChange={(pos) => take("servoPosAt100Pct", pos)}
      />
      <ServoSlider
        label={words.lowest}
        value={draft.controller.servoPosAt0Pct}
        onChange={(pos) => take("servoPosAt0Pct", pos)}
      />
      <TakeOrSkip
        label={words.next}
        isOff={draft.controller.servoPosAt0Pct === draft.controller.servoPosAt100Pct}
        onTake={() => onNext(draft)}
        onSkip={() => onNext(profile)}
      />
    </>
  );
};

interface ServoSliderProps {
  readonly label: string;
  readonly value: number;
  onChange(pos: number): void;
}

const ServoSlider = ({ label, value, onChange }: ServoSliderProps) => {
  const id = useId();
  return (
    <div className="servo-slider">
      <label htmlFor={id}>{label}</label>
      <input
        id={id}
        type="range"
        {...RANGE}
        value={value}
        onChange={(event) => onChange(Number(event.target.value))}
      />
      <output htmlFor={id}>{value}</output>
    </div>
  );
};
