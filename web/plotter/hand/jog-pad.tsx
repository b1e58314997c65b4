import { useRef, useState, type KeyboardEvent } from "react";
import type { HandMove } from "../../../src/schema/index.js";
import { jogText as words } from "./text.js";
import { ARROW_KEYS } from "../../ui/rows/arrow-keys.js";
import { Button } from "../../ui/button.js";
import { Segments } from "../../ui/fields/choice.js";
import { formatNumber } from "../../ui/format.js";
import { Icon } from "../../ui/icon.js";

const STEPS_MM = ["0.1", "1", "10", "50"] as const;
type StepMm = (typeof STEPS_MM)[number];

/** x to the right, y down the page, towards a person in front of the plotter. */
const DIRECTIONS = [
  ["upLeft", -1, -1],
  ["up", 0, -1],
  ["upRight", 1, -1],
  ["left", -1, 0],
  ["home", 0, 0],
  ["right", 1, 0],
  ["downLeft", -1, 1],
  ["down", 0, 1],
  ["downRight", 1, 1],
] as const;

/** Queued moves at most: more would continue after the key is released. */
const MAX_WAITING = 2;

interface JogPadProps {
  readonly isOff: boolean;
  move(move: HandMove): Promise<unknown>;
}

/** Eight directions and a step, by finger, mouse or the arrow keys. */
export const JogPad = ({ isOff, move }: JogPadProps) => {
  const [step, setStep] = useState<StepMm>("10");
  const queue = useTaskQueue();
  const go = (x: number, y: number): void => {
    const stepMm = Number(step);
    const isHome = x === 0 && y === 0;
    const wanted: HandMove = isHome ? { kind: "home" } : { kind: "jog", dxMm: x * stepMm, dyMm: y * stepMm };
    if (!isOff) queue(() => move(wanted));
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    const direction = ARROW_KEYS[event.key];
    if (!direction || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    go(...direction);
  };
  return (
    <div className="jog">
      <div className="jog-pad" role="group" aria-label={words.title} onKeyDown={onKeyDown}>
        {DIRECTIONS.map(([name, x, y]) => (
          <Button
            key={name}
            className="jog-button"
            aria-label={name === "home" ? words.home : words.by(words.directions[name], step)}
            disabled={isOff}
            onClick={() => go(x, y)}
          >
            {name === "home" ? <Icon name="home" /> : <Arrow x={x} y={y} />}
          </Button>
        ))}
      </div>
      <Segments<StepMm>
        label={words.step}
        value={step}
        options={STEPS_MM.map((mm) => ({ value: mm, label: `${formatNumber(Number(mm))} mm` }))}
        onChange={setStep}
      />
      <p className="note">{words.hint}</p>
    </div>
  );
};

/** Runs tasks one after the other. Drops new ones while the queue is full. */
const useTaskQueue = () => {
  const state = useRef<{ count: number; last: Promise<unknown> }>({ count: 0, last: Promise.resolve() });
  return (task: () => Promise<unknown>): void => {
    const now = state.current;
    if (now.count > MAX_WAITING) return;
    now.count++;
    now.last = now.last.then(task).finally(() => now.count--);
  };
};

const Arrow = ({ x, y }: { x: number; y: number }) => (
  <svg className="icon" viewBox="0 0 20 20" aria-hidden="true">
    <path d="M4 10h12M11 5l5 5-5 5" transform={`rotate(${(Math.atan2(y, x) * 180) / Math.PI} 10 10)`} />
  </svg>
);
