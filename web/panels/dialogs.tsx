import type { Shortcut } from "../state/shortcuts.js";
import { usePageState } from "../state/use-store.js";
import { lazyPart } from "../ui/lazy-part.js";

const HelpSheet = lazyPart(async () => (await import("./help.js")).HelpSheet);

/** The sheet that lies over the page, if any. */
export const Dialogs = ({ shortcuts }: { shortcuts: readonly Shortcut[] }) => {
  const dialog = usePageState((state) => state.openDialog);
  if (dialog === "keys") return <HelpSheet shortcuts={shortcuts} />;
  return null;
};
