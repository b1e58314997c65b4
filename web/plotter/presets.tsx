import { usePageState } from "../state/use-store.js";
import { presetsText } from "./text.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/settings-group.js";

const PresetList = lazyPart(async () => (await import("./preset-list.js")).PresetList);

export const PresetsPanel = () => {
  const count = usePageState((state) => state.presets.length);
  const isOpen = usePageState((state) => state.view.openGroups.includes("presets"));
  return (
    <SettingsGroup id="presets" title={presetsText.title} summary={count > 0 ? String(count) : ""}>
      {isOpen && <PresetList />}
    </SettingsGroup>
  );
};
