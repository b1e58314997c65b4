import { useState } from "react";
import { currentPlotter } from "../state/store.js";
import { usePageState } from "../state/use-store.js";
import { ringingText as words } from "./ringing-text.js";
import { Segments } from "../ui/fields/choice.js";
import { Sheet } from "../ui/dialog.js";
import { CountRipples } from "./count-ripples.js";
import { PickLine } from "./pick-line.js";
import "./ringing.css";

type Part = keyof typeof words.partNames;

/** Measures the plotter's swing by two sheets: the user counts ripples on the first and picks a line on the second. */
export const RingingDialog = () => {
  const [part, setPart] = useState<Part>("count");
  const isVirtual = usePageState((state) => currentPlotter(state)?.kind === "virtual");
  return (
    <Sheet title={words.title}>
      <div className="ringing">
        <p>{words.intro}</p>
        {isVirtual && <p className="note">{words.virtualHint}</p>}
        <Segments<Part>
          label={words.parts}
          isLabelHidden
          value={part}
          options={(["count", "pick"] as const).map((value) => ({ value, label: words.partNames[value] }))}
          onChange={setPart}
        />
        {part === "count" ? <CountRipples /> : <PickLine />}
      </div>
    </Sheet>
  );
};
