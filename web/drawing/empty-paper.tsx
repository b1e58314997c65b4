import { useLayoutEffect, useRef } from "react";
import "./empty-paper.css";
import { usePageState, useActions } from "../state/use-store.js";
import { emptyPaperText as words } from "./text.js";
import { ChooseDrawing } from "./drawing.js";
import { Thumb } from "./thumb.js";

/** Shown on the paper while there is no drawing: how to begin, and samples to try. */
export const EmptyPaper = () => {
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const element = box.current;
    return () => {
      // The sheet under it takes over the focus of a button that is removed with it.
      if (element?.contains(document.activeElement)) document.querySelector<HTMLElement>(".stage")?.focus();
    };
  }, []);
  return (
    <div ref={box} className="empty-paper">
      <strong>{words.title}</strong>
      <p>{words.hint}</p>
      <ChooseDrawing label={words.choose} />
      <Samples />
    </div>
  );
};

const Samples = () => {
  const samples = usePageState((state) => state.samples);
  const isBusy = usePageState((state) => state.busyAction === "sample");
  const { openSample } = useActions();
  if (samples.length === 0) return null;
  return (
    <section className="samples" aria-label={words.samples}>
      <h2>{words.samples}</h2>
      <ul>
        {samples.map(({ name, title }) => (
          <li key={name}>
            <button
              type="button"
              className="sample"
              // A disabled button would lose the focus.
              aria-disabled={isBusy}
              onClick={() => {
                if (!isBusy) void openSample(name, title);
              }}
            >
              <Thumb of="sample" id={name} />
              <span>{title}</span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
};
