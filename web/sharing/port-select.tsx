import type { Device, Plotter } from "../../src/schema/index.js";
import { sharingText as words } from "./text.js";
import { Select } from "../ui/fields/choice.js";
import { useFetched, useSharing } from "./use-sharing.js";

/** Chooses a plotter's port: automatic, one of the connected boards, or the virtual board. */
export const PortSelect = ({ plotter }: { plotter: Plotter }) => {
  const sharing = useSharing();
  const [answer] = useFetched(sharing.plotters.devices);
  const choices = portChoices(answer?.devices ?? [], plotter);
  const now = plotter.kind === "virtual" ? "virtual" : (plotter.device ?? "auto");
  return (
    <Select
      label={words.port}
      value={now}
      options={choices}
      onChange={(device) => void sharing.plotters.patch(plotter.id, { device })}
    />
  );
};

/** Without the ports of other plotters. Includes the plotter's own port even if it is unplugged. */
export const portChoices = (
  devices: readonly Device[],
  plotter: Plotter | null,
): readonly { value: string; label: string }[] => {
  const free = devices.filter(({ inUseBy }) => inUseBy === null || inUseBy === plotter?.id);
  const own = plotter?.device ?? null;
  const isGone = own !== null && !free.some(({ path }) => path === own);
  return [
    { value: "auto", label: words.portAuto },
    ...free.map(({ path, description }) => ({ value: path, label: `${path} ${description}`.trim() })),
    ...(isGone ? [{ value: own, label: own }] : []),
    { value: "virtual", label: words.portVirtual },
  ];
};
