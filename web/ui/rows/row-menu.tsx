import { useEffect, useRef, useState } from "react";
import { IconButton } from "../button.js";
import "./row-menu.css";

/** `label` includes the row's name, for screen readers. */
type MenuItem = readonly [words: string, label: string, isOff: boolean, run: () => void];

interface RowMenuProps {
  readonly label: string;
  readonly items: readonly MenuItem[];
}

/** A menu with a row's further buttons. Escape, a press outside or a press on a button closes it. */
export const RowMenu = ({ label, items }: RowMenuProps) => {
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
  /** The focus would be lost with the menu. */
  const close = (): void => {
    setOpen(false);
    opener.current?.focus();
  };
  return (
    <div
      className="row-menu"
      ref={box}
      onKeyDown={(event) => {
        if (event.key !== "Escape" || !isOpen) return;
        // A dialog around the menu stays open.
        event.preventDefault();
        close();
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
        <div ref={list} className="row-menu-list" role="group" aria-label={label}>
          {items.map(([words, itemLabel, isOff, run]) => (
            <button
              key={itemLabel}
              type="button"
              className="row-menu-item"
              aria-label={itemLabel}
              disabled={isOff}
              onClick={() => {
                close();
                run();
              }}
            >
              {words}
            </button>
          ))}
        </div>
      )}
    </div>
  );
};
