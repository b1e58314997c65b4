import { useEffect, useRef, type ReactNode } from "react";
import { Button } from "./button.js";
import { errorText } from "./text.js";
import { Icon } from "./icon.js";
import { useActions } from "../state/use-store.js";
import { Notices } from "./notices.js";
import "./dialog.css";

interface DialogProps {
  readonly title: string;
  /** Without a heading and a button to close it; the title is its name only. */
  readonly isBare?: boolean;
  readonly className?: string;
  onClose(): void;
  readonly children: ReactNode;
}

/** A modal dialog. The browser's own element keeps the focus inside and closes on Escape. */
export const Dialog = ({ title, isBare, className = "", onClose, children }: DialogProps) => {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const element = dialog.current;
    element?.showModal();
    return () => element?.close();
  }, []);
  return (
    <dialog
      ref={dialog}
      className={`dialog ${className}`.trim()}
      aria-label={title}
      // The event is asynchronous: another dialog may have replaced this one by then.
      onClose={() => {
        if (dialog.current) onClose();
      }}
    >
      {!isBare && (
        <header className="dialog-head">
          <h2>{title}</h2>
          <Button kind="tool" aria-label={errorText.close} onClick={onClose}>
            <Icon name="close" />
          </Button>
        </header>
      )}
      {children}
    </dialog>
  );
};

/** One of the page's dialogs. It shows the notices itself, because it covers the page's. */
export const Sheet = ({
  title,
  className = "",
  children,
}: Pick<DialogProps, "title" | "className" | "children">) => {
  const { closeDialog } = useActions();
  return (
    <Dialog title={title} className={className} onClose={closeDialog}>
      <Notices isInDialog />
      {children}
    </Dialog>
  );
};
