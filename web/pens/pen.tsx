import { usePageState } from "../state/use-store.js";
import { heightsText } from "./text.js";
import { formatNumber } from "../ui/format.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/settings-group.js";

const PenFields = lazyPart(async () => (await import("./pen-fields.js")).PenFields);

export const PenPanel = () => {
  const { liftMs, dropMs } = usePageState((state) => state.settings.pen);
  return (
    <SettingsGroup
      id="pen"
      isLazy
      title={heightsText.title}
      summary={`${formatNumber(liftMs)} / ${formatNumber(dropMs)} ms`}
    >
      <PenFields />
    </SettingsGroup>
  );
};
