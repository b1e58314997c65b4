import { useEffect, useRef, useState, type ReactNode } from "react";
import { IconButton } from "./button.js";
import "./row-menu.css";

/** A menu with a row's further buttons. Escape, a press outside or a press on a button closes it. */
export const RowMenu = ({ label, children }: { label: string; children: ReactNode }) => {
  const [isOpen, setOpen] = useState(false);
  const box = useRef<HTMLDivElement>(null);
  const opener = useRef<HTMLButtonElement>(null);
  const list = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!isOpen) return;
    // The last row's menu opens below the end of a column.
    list.current?.scrollIntoView({ block: "nearest" });
    const onPress = (event: PointerEvent): void => {
      if (!box.current?.contains(event.target as Node)) setOpen(false);
    };
    document.addEventListener("pointerdown", onPress);
    return () => document.removeEventListener("pointerdown", onPress);
  }, [isOpen]);
  return (
    <div
      className="row-menu"
      ref={box}
      onKeyDown={(event) => {
        if (event.key !== "Escape" || !isOpen) return;
        setOpen(false);
        opener.current?.focus();
      }}
    >
      <IconButton
        ref={opener}
        icon="more"
        label={label}
        aria-expanded={isOpen}
        onClick={() => setOpen(!isOpen)}
      />
      {isOpen && (
        <div
          ref={list}
          className="row-menu-list"
          role="group"
          aria-label={label}
          onClick={(event) => {
            if (event.target instanceof Element && event.target.closest("button")) setOpen(false);
          }}
        >
          {children}
        </div>
      )}
    </div>
  );
};

interface MenuItemProps {
  readonly words: string;
  /** Includes the row's name, for screen readers. */
  readonly label: string;
  readonly isOff?: boolean;
  onClick(): void;
}

export const MenuItem = ({ words, label, isOff = false, onClick }: MenuItemProps) => (
  <button type="button" className="row-menu-item" aria-label={label} disabled={isOff} onClick={onClick}>
    {words}
  </button>
);
