import type { ReactNode } from "react";
import { useActions, usePageState } from "../state/use-store.js";
import { Group } from "./group.js";

interface SettingsGroupProps {
  readonly id: string;
  readonly title: string;
  readonly summary?: string;
  readonly help?: string;
  readonly isPart?: boolean;
  readonly children: ReactNode;
}

/** A group that can be folded; its state is remembered. */
export const SettingsGroup = ({ id, ...props }: SettingsGroupProps) => {
  const openGroups = usePageState((state) => state.view.openGroups);
  const { changeView } = useActions();
  return (
    <Group
      {...props}
      id={id}
      isOpen={openGroups.includes(id)}
      onToggle={(isOpen) =>
        changeView({ openGroups: isOpen ? [...openGroups, id] : openGroups.filter((other) => other !== id) })
      }
    />
  );
};
