import { usePageState } from "../state/use-store.js";
import { presetsText } from "./text.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/settings-group.js";

const PresetList = lazyPart(async () => (await import("./preset-list.js")).PresetList);

export const PresetsPanel = () => {
  const count = usePageState((state) => state.presets.length);
  return (
    <SettingsGroup id="presets" isLazy title={presetsText.title} summary={count > 0 ? String(count) : ""}>
      <PresetList />
    </SettingsGroup>
  );
};
