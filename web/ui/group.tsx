import type { ReactNode } from "react";
import { useHint } from "./hint.js";
import { Icon } from "./icon.js";

interface GroupProps {
  readonly id: string;
  readonly title: string;
  /** The group's values in a few words, shown beside the title. */
  readonly summary?: string;
  /** Help on demand, while the group is open. */
  readonly help?: string;
  /** Is inside another group. */
  readonly isPart?: boolean;
  readonly isOpen: boolean;
  onToggle(isOpen: boolean): void;
  readonly children: ReactNode;
}

/** A group of settings that can be folded. */
export const Group = (props: GroupProps) => {
  const { id, title, summary, help, isPart, isOpen, onToggle, children } = props;
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
            onClick={() => onToggle(!isOpen)}
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
        {children}
      </div>
    </section>
  );
};
