import type { ReactNode } from "react";
import { usePageState } from "../state/use-store.js";
import { layersText } from "./text.js";
import { lazyPart } from "../ui/lazy-part.js";
import { Panel } from "../ui/panel.js";

const LayerList = lazyPart(async () => (await import("./layer-list.js")).LayerList);

/** `children`: the pens, which are in another folder. */
export const LayersPanel = ({ children }: { children: ReactNode }) => {
  const count = usePageState((state) => state.planned?.layers.length ?? 0);
  return (
    <Panel id="layers" title={layersText.title} summary={count > 0 ? String(count) : ""}>
      <LayerList />
      {children}
    </Panel>
  );
};
