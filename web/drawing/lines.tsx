import { FillPanel } from "./fill.js";
import { usePageState } from "../state/use-store.js";
import { linesText } from "./text.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/settings-group.js";

const LinesFields = lazyPart(async () => (await import("./lines-fields.js")).LinesFields);

export const LinesPanel = () => {
  const isOpen = usePageState((state) => state.view.openGroups.includes("lines"));
  return (
    <SettingsGroup id="lines" title={linesText.title}>
      {isOpen && <LinesFields />}
      <FillPanel />
    </SettingsGroup>
  );
};
