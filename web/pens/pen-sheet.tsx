import {
  PEN_SHEET_HEIGHT_MM,
  PEN_SHEET_MOTION,
  PEN_SHEET_WAITS_MS,
  PEN_SHEET_WIDTH_MM,
  penOfSheet,
  penSheet,
} from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { middlePlace, sheetSettings, type SheetJob } from "../ringing/ringing-job.js";
import { activeJob } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { Select } from "../ui/fields/choice.js";
import { usePenChange } from "../ui/use-change.js";
import { heightsText } from "./text.js";

const words = heightsText.sheet;

/** The job that plots the pen sheet. Null: not enough room. */
export const penSheetJob = (settings: PlotSettings, name: string): SheetJob | null => {
  const place = middlePlace(settings, PEN_SHEET_WIDTH_MM, PEN_SHEET_HEIGHT_MM);
  if (place === null) return null;
  const sheet = sheetSettings(settings, place.xMm, place.yMm);
  return {
    name,
    drawing: penSheet(),
    settings: { ...sheet, motion: PEN_SHEET_MOTION, pen: penOfSheet(sheet.pen) },
  };
};

const NOT_READ = "";
/** The first line is only there to compare with. */
const CHOICES = PEN_SHEET_WAITS_MS.slice(1);

export const PlotPenSheet = () => {
  const settings = usePageState((state) => state.settings);
  const isPlotting = usePageState((state) => activeJob(state)?.name === words.jobName);
  const { plotJob } = useActions();
  const job = penSheetJob(settings, words.jobName);
  return (
    <>
      <Button disabled={job === null || isPlotting} onClick={() => job && void plotJob(job)}>
        {isPlotting ? words.plotting : words.plot}
      </Button>
      {job === null && (
        <p className="note note-error">{words.noRoom(PEN_SHEET_WIDTH_MM, PEN_SHEET_HEIGHT_MM)}</p>
      )}
    </>
  );
};

/** Plots the pen sheet, and stores the number of the lowest line that is right as both extra waits. */
export const PenSheet = () => {
  const { extraLiftMs, extraDropMs } = usePageState((state) => state.settings.pen);
  const change = usePenChange();
  const isRead = extraLiftMs === extraDropMs && CHOICES.includes(extraLiftMs);
  return (
    <>
      <p className="note">{words.hint}</p>
      <PlotPenSheet />
      <Select
        label={words.lowest}
        value={isRead ? String(extraLiftMs) : NOT_READ}
        options={[
          { value: NOT_READ, label: words.notRead },
          ...CHOICES.map((ms) => ({ value: String(ms), label: words.line(ms) })),
        ]}
        onChange={(value) => {
          const ms = Number(value);
          if (value !== NOT_READ) change({ extraLiftMs: ms, extraDropMs: ms });
        }}
      />
    </>
  );
};
