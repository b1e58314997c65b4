import { dropTime, findMachine, liftTime, timedPen } from "../../src/internal.js";
import { usePageState } from "../state/use-store.js";
import { pensText, heightsText } from "./text.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/fields/settings-group.js";
import { formatFixed } from "../ui/format.js";

const PenList = lazyPart(async () => (await import("./pen-list.js")).PenList);

/** The pens of the layers; part of the layers' panel. */
export const PensPanel = () => {
  const pens = usePageState(({ settings }) => settings.pens);
  return (
    <SettingsGroup
      id="pens"
      isPart
      isLazy
      title={pensText.title}
      summary={pens.map(({ name }) => name).join(", ")}
      help={pensText.hint}
    >
      <PenList />
    </SettingsGroup>
  );
};

const PenFields = lazyPart(async () => (await import("./pen-fields.js")).PenFields);

export const PenPanel = () => {
  const settings = usePageState((state) => state.settings);
  const pen = timedPen(settings.pen, findMachine(settings));
  const [liftMs, dropMs] = [liftTime(pen, pen.upPct), dropTime(pen, pen.upPct)].map((s) => 1_000 * s);
  return (
    <SettingsGroup
      id="pen"
      isLazy
      title={heightsText.title}
      summary={`${formatFixed(liftMs, 0)} / ${formatFixed(dropMs, 0)} ms`}
    >
      <PenFields />
    </SettingsGroup>
  );
};
