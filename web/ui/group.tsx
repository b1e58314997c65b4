import type { ReactNode } from "react";
import { Icon } from "./icon.js";

interface GroupProps {
  readonly id: string;
  readonly title: string;
  /** The group in a few words, shown beside the title. */
  readonly summary?: string;
  readonly isOpen: boolean;
  onToggle(isOpen: boolean): void;
  readonly children: ReactNode;
}

/** A group of settings that folds. */
export const Group = ({ id, title, summary, isOpen, onToggle, children }: GroupProps) => (
  <section className="group" data-open={isOpen || undefined}>
    <h2>
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
    </h2>
    <div id={`group-${id}`} className="group-body" hidden={!isOpen}>
      {children}
    </div>
  </section>
);
