import { useEffect, useState, type ReactNode } from "react";

interface DropZoneProps {
  /** One, or the one for the left half of the page and the one for the right half. */
  readonly hints: readonly string[];
  /** `isRight`: dropped on the right half of two, or with Shift held. */
  onFiles(files: readonly File[], isRight: boolean): void;
  onText(text: string): void;
  readonly children: ReactNode;
}

/** Accepts files dropped anywhere on the page, and text pasted anywhere except into a field. */
export const DropZone = ({ hints, onFiles, onText, children }: DropZoneProps) => {
  /** The half that files are dragged over; null: none. */
  const [over, setOver] = useState<number | null>(null);
  const halves = hints.length;
  useEffect(() => {
    // Each element that the pointer crosses sends both events: entering counts up, leaving counts down.
    let depth = 0;
    const hasFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;
    const enter = (event: DragEvent): void => {
      if (!hasFiles(event)) return;
      depth++;
      setOver(halfAt(event));
    };
    const leave = (event: DragEvent): void => {
      if (hasFiles(event) && --depth <= 0) setOver(null);
    };
    const move = (event: DragEvent): void => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      setOver(halfAt(event));
    };
    const halfAt = ({ clientX, shiftKey }: DragEvent): number =>
      halves > 1 && (shiftKey || clientX > innerWidth / 2) ? 1 : 0;
    const drop = (event: DragEvent): void => {
      depth = 0;
      setOver(null);
      const files = [...(event.dataTransfer?.files ?? [])];
      if (files.length === 0) return;
      event.preventDefault();
      onFiles(files, halfAt(event) === 1);
    };
    const paste = (event: ClipboardEvent): void => {
      if (event.target instanceof HTMLInputElement || event.target instanceof HTMLTextAreaElement) return;
      const file = event.clipboardData?.files[0];
      const text = event.clipboardData?.getData("text/plain") ?? "";
      if (file) onFiles([file], false);
      else if (text !== "") onText(text);
    };
    const stop = new AbortController();
    const { signal } = stop;
    document.addEventListener("dragenter", enter, { signal });
    document.addEventListener("dragleave", leave, { signal });
    document.addEventListener("dragover", move, { signal });
    document.addEventListener("drop", drop, { signal });
    document.addEventListener("paste", paste, { signal });
    return () => stop.abort();
  }, [halves, onFiles, onText]);
  return (
    <>
      {children}
      {over !== null && (
        <div className="drop-hints" aria-hidden="true">
          {hints.map((hint, half) => (
            <p key={hint} className="drop-hint" data-over={half === over || undefined}>
              {hint}
            </p>
          ))}
        </div>
      )}
    </>
  );
};
