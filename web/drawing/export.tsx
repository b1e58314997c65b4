import { usePageState } from "../state/use-store.js";
import { saveText } from "./text.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/settings-group.js";

const ExportList = lazyPart(async () => (await import("./export-list.js")).ExportList);

/** Saves what will be plotted as files. */
export const ExportPanel = () => {
  const canExport = usePageState((state) => (state.planned?.strokeCount ?? 0) > 0);
  if (!canExport) return null;
  return (
    <SettingsGroup id="export" title={saveText.title} isPart isLazy>
      <ExportList />
    </SettingsGroup>
  );
};
