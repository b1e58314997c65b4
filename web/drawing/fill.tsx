import { usePageState } from "../state/use-store.js";
import { fillText as words } from "./text.js";
import { formatNumber } from "../ui/format.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/settings-group.js";

const FillFields = lazyPart(async () => (await import("./fill-fields.js")).FillFields);

export const FillPanel = () => {
  const { spacingMm } = usePageState((state) => state.settings.prepare.hatch);
  return (
    <SettingsGroup
      id="fill"
      isPart
      isLazy
      title={words.title}
      summary={spacingMm > 0 ? words.on(formatNumber(spacingMm)) : words.off}
    >
      <FillFields />
    </SettingsGroup>
  );
};
