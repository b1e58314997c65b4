import { MOST_SMOOTH_ROUNDS, type PlotSettings } from "../../src/schema/index.js";
import { usePageState } from "../state/use-store.js";
import { setup } from "../text/setup.js";
import { Segments, Switch } from "../ui/choice.js";
import { NumberField } from "../ui/number-field.js";
import { usePrepareChange } from "./paper.js";

const words = setup.lines;

/** The plain lengths, in the order in which they are applied. */
const LENGTHS = [
  { key: "joinMm", label: words.join, min: 0, max: 50, step: 0.05 },
  { key: "dropShorterMm", label: words.drop, min: 0, max: 1_000, step: 0.1 },
  { key: "dropRepeatsMm", label: words.repeats, min: 0, max: 5, step: 0.05 },
  { key: "simplifyMm", label: words.simplify, min: 0, max: 5, step: 0.01 },
  { key: "flattenMm", label: words.flatten, min: 0.001, max: 5, step: 0.01 },
] as const satisfies readonly { key: keyof PlotSettings["prepare"]; [more: string]: unknown }[];

/** How strokes are ordered, joined and cleaned. */
export const LinesFields = () => {
  const prepare = usePageState((state) => state.settings.prepare);
  const change = usePrepareChange();
  return (
    <>
      <Segments
        label={words.order}
        value={prepare.order}
        options={[
          { value: "none", label: words.orderNone },
          { value: "fast", label: words.orderFast },
          { value: "best", label: words.orderBest },
        ]}
        onChange={(order) => change("order", { order })}
      />
      {prepare.order === "best" && (
        <NumberField
          label={words.orderS}
          value={prepare.orderS}
          unit="s"
          min={0.1}
          max={600}
          step={1}
          onChange={(orderS) => change("order time", { orderS })}
        />
      )}
      <Segments
        label={words.spread}
        value={prepare.spread}
        options={[
          { value: "none", label: words.spreads.none },
          { value: "interleave", label: words.spreads.interleave },
          { value: "shuffle", label: words.spreads.shuffle },
        ]}
        onChange={(spread) => change("spread", { spread })}
      />
      {prepare.spread !== "none" && <p className="note">{words.spreadHint}</p>}
      {LENGTHS.map(({ key, label, min, max, step }) => (
        <NumberField
          key={key}
          label={label}
          value={prepare[key]}
          unit="mm"
          min={min}
          max={max}
          step={step}
          digits={3}
          onChange={(value) => change(key, { [key]: value })}
        />
      ))}
      <NumberField
        label={words.smooth}
        value={prepare.smoothRounds}
        unit=""
        min={0}
        max={MOST_SMOOTH_ROUNDS}
        step={1}
        digits={0}
        onChange={(rounds) => change("smooth", { smoothRounds: Math.round(rounds) })}
      />
      <Switch
        label={words.reloop}
        isOn={prepare.reloop}
        onChange={(reloop) => change("reloop", { reloop })}
      />
    </>
  );
};
