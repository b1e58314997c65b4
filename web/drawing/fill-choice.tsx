import { useEffect, useRef, useState } from "react";
import { isSameJson } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { useActions, usePageState } from "../state/use-store.js";
import { formatCount } from "../ui/format.js";
import { usePrepareChange } from "../ui/use-change.js";
import type { Sketch } from "../worker/protocol.js";
import { FIRST_SPACING_MM } from "./fill-fields.js";
import { fillChoiceText as words } from "./text.js";

type Prepare = PlotSettings["prepare"];

const WAYS = ["outline", "hatch", "hide"] as const;
type Way = (typeof WAYS)[number];

const changeTo = (way: Way, { hatch }: Pick<Prepare, "hatch">) =>
  ({
    outlineFills: true,
    hideCovered: way === "hide",
    hatch: { ...hatch, spacingMm: way === "hatch" ? hatch.spacingMm || FIRST_SPACING_MM : 0 },
  }) satisfies Partial<Prepare>;

/** Null: as the panel of lines says, in another way. */
const wayNow = ({ hatch, hideCovered, outlineFills }: Prepare): Way | null =>
  WAYS.find((way) => isSameJson(changeTo(way, { hatch }), { outlineFills, hideCovered, hatch })) ?? null;

/** A pen can't fill: what becomes of the filled shapes, with small pictures of this drawing. */
export const FillChoice = () => {
  const count = usePageState((state) => state.planned?.fillCount ?? 0);
  const now = usePageState((state) => wayNow(state.settings.prepare));
  const hatch = usePageState((state) => state.settings.prepare.hatch);
  const sketches = useSketches();
  const change = usePrepareChange();
  if (count === 0) return null;
  return (
    <div className="fill-choice" role="group" aria-label={words.label}>
      <p>{words.count(count, formatCount(count))}</p>
      <div className="fill-ways">
        {WAYS.map((way, i) => (
          <button
            key={way}
            type="button"
            aria-pressed={way === now}
            onClick={() => change("fills", changeTo(way, { hatch }))}
          >
            {sketches[i] && <SketchPicture sketch={sketches[i]} />}
            <span>{words.ways[way]}</span>
          </button>
        ))}
      </div>
    </div>
  );
};

/** In the order of `WAYS`; empty until they are made, and for a drawing that is too large. */
const useSketches = (): readonly Sketch[] => {
  const planned = usePageState((state) => state.planned);
  const [made, setMade] = useState<{ readonly key: string; readonly sketches: readonly Sketch[] } | null>(
    null,
  );
  const { askSketches } = useActions();
  const isAsked = planned !== null && planned.fillCount > 0;
  useEffect(() => {
    if (!isAsked) return;
    const { drawingKey: key, settings } = planned;
    const changes = WAYS.map((way) => changeTo(way, settings.prepare));
    askSketches(changes, (sketches) => setMade({ key, sketches }));
  }, [planned, isAsked, askSketches]);
  return made !== null && made.key === planned?.drawingKey ? made.sketches : [];
};

const WIDTH_PX = 88;
const HEIGHT_PX = 62;
const PAD_PX = 5;
const RATIO = 2;

const SketchPicture = ({ sketch: { box, xy, offsets } }: { sketch: Sketch }) => {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const context = canvas.current?.getContext("2d");
    if (!context) return;
    const scale = (HEIGHT_PX - 2 * PAD_PX) / (box.y1 - box.y0);
    context.setTransform(RATIO, 0, 0, RATIO, 0, 0);
    context.clearRect(0, 0, WIDTH_PX, HEIGHT_PX);
    context.translate(WIDTH_PX / 2, HEIGHT_PX / 2);
    context.scale(scale, scale);
    context.translate(-(box.x0 + box.x1) / 2, -(box.y0 + box.y1) / 2);
    context.beginPath();
    for (let i = 0; i + 1 < offsets.length; i++) {
      for (let p = offsets[i]; p < offsets[i + 1]; p++) {
        if (p === offsets[i]) context.moveTo(xy[2 * p], xy[2 * p + 1]);
        else context.lineTo(xy[2 * p], xy[2 * p + 1]);
      }
    }
    context.lineWidth = 0.7 / scale;
    context.lineJoin = "round";
    context.strokeStyle = "#24221e";
    context.stroke();
  }, [box, xy, offsets]);
  return <canvas ref={canvas} width={WIDTH_PX * RATIO} height={HEIGHT_PX * RATIO} aria-hidden="true" />;
};
