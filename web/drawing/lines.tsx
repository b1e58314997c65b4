import { usePageState } from "../state/use-store.js";
import { linesText, fillText as words } from "./text.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/fields/settings-group.js";
import { Panel } from "../ui/panel.js";
import { formatNumber } from "../ui/format.js";

const LinesFields = lazyPart(async () => (await import("./lines-fields.js")).LinesFields);

export const LinesPanel = () => (
  <Panel id="lines" title={linesText.title}>
    <LinesFields />
    <FillPanel />
  </Panel>
);

const FillFields = lazyPart(async () => (await import("./fill-fields.js")).FillFields);

const FillPanel = () => {
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
