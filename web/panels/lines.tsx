import { usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "./settings-group.js";

const LinesFields = lazyPart(async () => (await import("./lines-fields.js")).LinesFields);

export const LinesPanel = () => {
  const isOpen = usePageState((state) => state.view.openGroups.includes("lines"));
  return (
    <SettingsGroup id="lines" title={text.lines.title}>
      {isOpen && <LinesFields />}
    </SettingsGroup>
  );
};
