import { useMemo } from "react";
import { activeJob, isReady, mayOperate, selectedStroke } from "../state/store.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import { Button, IconButton } from "../ui/button.js";
import { Facts } from "../ui/facts.js";
import { formatCount, formatLength, formatMoment, formatNumber } from "../ui/format.js";
import { penLooks } from "./view-modes.js";
import { strokeFigures } from "./stroke.js";
import { strokeText as words } from "./text.js";

/** The clicked stroke: its numbers, and a button to plot from its beginning. */
export const StrokeCard = () => {
  const selected = usePageState(selectedStroke);
  const settings = usePageState((state) => state.settings);
  const store = usePageStore();
  const figures = useMemo(
    () => selected && strokeFigures(selected.of, selected.hover.strokeNumber - 1),
    [selected],
  );
  if (!selected || !figures) return null;
  const { of: planned, hover } = selected;
  const { widthMm } = penLooks({ planned, settings })[hover.layer];
  return (
    <section className="stroke-card" aria-label={words.title}>
      <header>
        <strong>{words.strokeOf(formatCount(hover.strokeNumber), formatCount(planned.strokeCount))}</strong>
        <IconButton icon="close" label={words.close} onClick={() => store.setState({ selected: null })} />
      </header>
      <p>{hover.layerName}</p>
      <Facts
        rows={[
          [words.length, formatLength(figures.lengthMm)],
          [words.width, `${formatNumber(widthMm, 2)} mm`],
          [words.takes, words.seconds(formatNumber(figures.durationS, 2))],
          [words.begins, formatMoment(figures.startS)],
          [words.speedHere, `${formatNumber(hover.speedMmPerS, 1)} mm/s`],
        ]}
      />
      <PlotFromHere strokeIndex={hover.strokeNumber - 1} />
    </section>
  );
};

const PlotFromHere = ({ strokeIndex }: { strokeIndex: number }) => {
  const isOff = usePageState(
    (state) =>
      !isReady(state) || !mayOperate(state) || activeJob(state) !== null || state.busyAction !== null,
  );
  const { plotDrawing } = useActions();
  return (
    <>
      <Button disabled={isOff} onClick={() => void plotDrawing({ strokeIndex, alongMm: 0 })}>
        {words.plotFrom}
      </Button>
      <p className="note">{words.plotFromHint}</p>
    </>
  );
};
