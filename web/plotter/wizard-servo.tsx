import { useId, useRef, useState } from "react";
import { isEbbMachine, withController, type EbbMachine } from "./profile.js";
import { wizardText } from "./wizard-text.js";
import { ServoPin } from "./profile-form.js";
import { TakeOrSkip } from "./take-or-skip.js";
import { useHand } from "./use-hand.js";
import type { StepProps } from "./wizard-step.js";

const words = wizardText;
/** In 1/12 µs; a servo listens between about 0.4 and 2.6 ms. */
const RANGE = { min: 5_000, max: 31_000, step: 100 } as const;

/** Only an EiBotBoard has its servo set up here. */
export const ServoStep = ({ profile, ...props }: StepProps) =>
  isEbbMachine(profile) ? (
    <EbbServoStep profile={profile} {...props} />
  ) : (
    <TakeOrSkip label={words.next} isOff onTake={() => undefined} onSkip={() => props.onNext(profile)} />
  );

/** The pen follows two sliders; where it has just the right height is the servo's range. */
const EbbServoStep = ({ profile, settingsWith, onNext }: StepProps & { readonly profile: EbbMachine }) => {
  const [draft, setDraft] = useState(profile);
  const moveTo = useServo(() => settingsWith(draft));
  const take = (which: "servoPosAt0Pct" | "servoPosAt100Pct", pos: number): void => {
    setDraft(withController(draft, { [which]: pos }));
    moveTo(pos);
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

/** Sends a position at a time: while one is on its way only the latest of the others is kept. */
const useServo = (settings: () => ReturnType<StepProps["settingsWith"]>) => {
  const hand = useHand();
  const state = useRef<{ isSending: boolean; next: number | null }>({ isSending: false, next: null });
  const send = async (): Promise<void> => {
    const now = state.current;
    if (now.isSending) return;
    now.isSending = true;
    while (now.next !== null) {
      const pos = now.next;
      now.next = null;
      await hand.servo(pos, settings());
    }
    now.isSending = false;
  };
  return (pos: number): void => {
    state.current.next = pos;
    void send();
  };
};
