import { useEffect, useState, type ReactNode } from "react";

interface DropZoneProps {
  readonly hint: string;
  onFile(file: File): Promise<void>;
  onText(text: string): void;
  readonly children: ReactNode;
}

/** Accepts files dropped anywhere on the page, and text pasted anywhere except into a field. */
export const DropZone = ({ hint, onFile, onText, children }: DropZoneProps) => {
  const [isOver, setOver] = useState(false);
  useEffect(() => {
    // Each element that the pointer crosses sends both events: entering counts up, leaving counts down.
    let depth = 0;
    const hasFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;
    const enter = (event: DragEvent): void => {
      if (!hasFiles(event)) return;
      depth++;
      setOver(true);
    };
    const leave = (event: DragEvent): void => {
      if (hasFiles(event) && --depth <= 0) setOver(false);
    };
    const over = (event: DragEvent): void => {
      if (hasFiles(event)) event.preventDefault();
    };
    const drop = (event: DragEvent): void => {
      depth = 0;
      setOver(false);
      const file = event.dataTransfer?.files[0];
      if (!file) return;
      event.preventDefault();
      void onFile(file);
    };
    const paste = (event: ClipboardEvent): void => {
      if (event.target instanceof HTMLInputElement || event.target instanceof HTMLTextAreaElement) return;
      const file = event.clipboardData?.files[0];
      const text = event.clipboardData?.getData("text/plain") ?? "";
      if (file) void onFile(file);
      else if (text !== "") onText(text);
    };
    const stop = new AbortController();
    const { signal } = stop;
    document.addEventListener("dragenter", enter, { signal });
    document.addEventListener("dragleave", leave, { signal });
    document.addEventListener("dragover", over, { signal });
    document.addEventListener("drop", drop, { signal });
    document.addEventListener("paste", paste, { signal });
    return () => stop.abort();
  }, [onFile, onText]);
  return (
    <>
      {children}
      {isOver && (
        <div className="drop-hint" aria-hidden="true">
          <p>{hint}</p>
        </div>
      )}
    </>
  );
};
