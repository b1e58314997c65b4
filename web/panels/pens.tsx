import { usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "./settings-group.js";

const PenList = lazyPart(async () => (await import("./pen-list.js")).PenList);

/** The pens that layers are drawn with. */
export const PensPanel = () => {
  const pens = usePageState(({ settings }) => settings.pens);
  const isOpen = usePageState(({ view }) => view.openGroups.includes("pens"));
  return (
    <SettingsGroup id="pens" title={text.pens.title} summary={pens.map(({ name }) => name).join(", ")}>
      {isOpen && <PenList />}
    </SettingsGroup>
  );
};
