import "./layout.css";
import type { PlotSettings } from "../../src/schema/index.js";
import { boxAround, snapLinesOf } from "../scene/placing.js";
import { deskOf } from "../preview/desk.js";
import { frameNow } from "../preview/frame.js";
import { usePageState, usePageStore } from "../state/use-store.js";
import { layoutText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { NumberField } from "../ui/fields/number-field.js";
import { usePrepareChange } from "../ui/use-change.js";

type LayoutBox = NonNullable<PlotSettings["prepare"]["layout"]>;

/** Position and size of the drawing. Its proportions stay, so setting one size sets the other. */
export const LayoutFields = ({ layout }: { layout: LayoutBox }) => {
  const frame = usePageState((state) => state.planned?.frameMm ?? null);
  const change = usePrepareChange();
  const set = (part: Partial<LayoutBox>): void =>
    change(`layout ${Object.keys(part).join()}`, { layout: { ...layout, ...part } });
  const fields = [
    ["xMm", words.x, layout.xMm, -10_000],
    ["yMm", words.y, layout.yMm, -10_000],
    ["widthMm", words.width, layout.widthMm ?? frame?.widthMm ?? 0, 0.1],
    ["heightMm", words.height, layout.heightMm ?? frame?.heightMm ?? 0, 0.1],
  ] as const;
  return (
    <>
      <div className="field-pair">
        {fields.map(([key, label, value, min]) => (
          <NumberField
            key={key}
            label={label}
            value={value}
            unit="mm"
            min={min}
            max={10_000}
            step={1}
            onChange={(mm) => {
              if (key === "widthMm") set({ widthMm: mm, heightMm: null });
              else if (key === "heightMm") set({ widthMm: null, heightMm: mm });
              else set({ [key]: mm });
            }}
          />
        ))}
      </div>
      <Aligning set={set} layout={layout} />
      <p className="note">{words.hint}</p>
    </>
  );
};

interface AligningProps {
  readonly layout: LayoutBox;
  set(part: Partial<LayoutBox>): void;
}

/** Centres the drawing on the paper, or fits it into the margins. */
const Aligning = ({ layout, set }: AligningProps) => {
  const store = usePageStore();
  const align = (where: "across" | "down" | "fill"): void => {
    const state = store.getState();
    const frame = frameNow(state);
    if (!frame) return;
    const { paperMm, margins, turn } = deskOf(state.settings, state.view);
    const { xs, ys } = snapLinesOf(paperMm, margins);
    const { x0, y0, x1, y1 } = boxAround(frame);
    const [left, right, top, bottom] = [xs[1], xs[3], ys[1], ys[3]];
    // As the sheet is seen, which may be turned.
    const isAlongX = (where === "across") === (turn % 2 === 0);
    if (where !== "fill") {
      if (isAlongX) return set({ xMm: rounded(layout.xMm + (paperMm.width - x0 - x1) / 2) });
      return set({ yMm: rounded(layout.yMm + (paperMm.height - y0 - y1) / 2) });
    }
    const factor = Math.min((right - left) / (x1 - x0), (bottom - top) / (y1 - y0));
    if (!Number.isFinite(factor)) return;
    const widthMm = frame.widthMm * factor;
    set({
      xMm: rounded((left + right - widthMm) / 2),
      yMm: rounded((top + bottom - frame.heightMm * factor) / 2),
      widthMm: rounded(widthMm),
      heightMm: null,
    });
  };
  return (
    <div className="align-buttons">
      {(["across", "down", "fill"] as const).map((where) => (
        <Button key={where} kind="small" onClick={() => align(where)}>
          {words.align[where]}
        </Button>
      ))}
    </div>
  );
};

/** Rounded down to 0.01 mm, so that a drawing that fills the margins is not cut off by them. */
const rounded = (mm: number): number => Math.floor(mm * 100 + 1e-6) / 100;
