import { usePageState } from "../state/use-store.js";
import { pensText } from "./text.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/settings-group.js";

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
