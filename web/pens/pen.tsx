import { usePageState } from "../state/use-store.js";
import { heightsText } from "./text.js";
import { formatNumber } from "../ui/format.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/settings-group.js";

const PenFields = lazyPart(async () => (await import("./pen-fields.js")).PenFields);

export const PenPanel = () => {
  const { liftMs, dropMs } = usePageState((state) => state.settings.pen);
  const isOpen = usePageState((state) => state.view.openGroups.includes("pen"));
  return (
    <SettingsGroup
      id="pen"
      title={heightsText.title}
      summary={`${formatNumber(liftMs)} / ${formatNumber(dropMs)} ms`}
    >
      {isOpen && <PenFields />}
    </SettingsGroup>
  );
};
