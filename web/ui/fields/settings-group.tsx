import type { ReactNode } from "react";
import { useActions, usePageState } from "../../state/use-store.js";
import { useHint } from "../hint.js";
import { Icon } from "../icon.js";

interface SettingsGroupProps {
  readonly id: string;
  readonly title: string;
  /** The group's values in a few words, shown beside the title. */
  readonly summary?: string | undefined;
  /** Help on demand, while the group is open. */
  readonly help?: string;
  /** Is inside another group. */
  readonly isPart?: boolean;
  /** The children are rendered only while the group is open, so that a lazy part is loaded when it is needed. */
  readonly isLazy?: boolean;
  readonly children: ReactNode;
}

/** A group of settings that can be folded; its state is remembered. */
export const SettingsGroup = (props: SettingsGroupProps) => {
  const { id, title, summary, help, isPart, isLazy, children } = props;
  const openGroups = usePageState((state) => state.view.openGroups);
  const { changeView } = useActions();
  const isOpen = openGroups.includes(id);
  const toggle = (): void =>
    changeView({ openGroups: isOpen ? openGroups.filter((other) => other !== id) : [...openGroups, id] });
  const Heading = isPart ? "h3" : "h2";
  const hint = useHint(title, `help-${id}`, isOpen ? help : undefined);
  return (
    <section className={isPart ? "group group-part" : "group"} data-open={isOpen || undefined}>
      <div className="group-top">
        <Heading>
          <button
            type="button"
            className="group-head"
            aria-expanded={isOpen}
            aria-controls={`group-${id}`}
            onClick={toggle}
          >
            <Icon name="chevron" />
            <span className="group-title">{title}</span>
            {summary && <span className="group-summary">{summary}</span>}
          </button>
        </Heading>
        {hint.button}
      </div>
      <div id={`group-${id}`} className="group-body" hidden={!isOpen}>
        {hint.note}
        {(isOpen || !isLazy) && children}
      </div>
    </section>
  );
};
