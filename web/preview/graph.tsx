import { useEffect, useRef, useState, type RefObject } from "react";
import UPlot from "uplot";
import { type Trajectory, stateAt } from "../../src/index.js";
import { DESK_FONT } from "./backdrop.js";
import { usePageState, usePageStore } from "../state/use-store.js";
import { timeLineText as words } from "./text.js";
import { formatMoment, formatNumber } from "../ui/format.js";
import "uplot/dist/uPlot.min.css";

const HEIGHT_PX = 132;

interface GraphProps {
  /** The slider of the time line: the graph begins and ends where the middle of its thumb does. */
  readonly slider: RefObject<HTMLInputElement | null>;
  onSeek(tS: number): void;
}

/** Speed and acceleration over time. A drag zooms, a double click shows everything, a click goes to that moment. */
export const Graph = ({ slider, onSeek }: GraphProps) => {
  const box = useRef<HTMLDivElement>(null);
  const store = usePageStore();
  const trajectory = usePageState((state) => state.planned?.trajectory ?? null);
  const theme = usePageState((state) => state.view.theme);
  const isDark = useIsDark();
  useEffect(() => {
    if (!box.current || !trajectory) return;
    const element = box.current;
    const room = (): Room => roomBeside(element, slider.current);
    const plot = makePlot(element, trajectory, room, () => store.getState().momentS, onSeek);
    const stop = store.subscribe((state, before) => {
      if (state.momentS !== before.momentS) plot.redraw(false);
    });
    const observer = new ResizeObserver(() =>
      plot.setSize({ width: element.clientWidth, height: HEIGHT_PX }),
    );
    observer.observe(element);
    return () => {
      observer.disconnect();
      stop();
      plot.destroy();
    };
  }, [store, trajectory, theme, isDark, slider, onSeek]);
  return (
    <div className="graph">
      <p className="graph-units" aria-hidden="true">
        <span>{words.speed}</span>
        <span>{words.accel}</span>
      </p>
      <div ref={box} role="img" aria-label={words.graph} />
    </div>
  );
};

/** Whether the system's theme is dark; it may change while the graph is open. */
const useIsDark = (): boolean => {
  const [isDark, setDark] = useState(false);
  useEffect(() => {
    const scheme = matchMedia("(prefers-color-scheme: dark)");
    const read = (): void => setDark(scheme.matches);
    read();
    scheme.addEventListener("change", read);
    return () => scheme.removeEventListener("change", read);
  }, []);
  return isDark;
};

/** For the numbers of the two axes, px. */
interface Room {
  readonly left: number;
  readonly right: number;
}

/** The width of the numbers. */
const LEAST_ROOM: Room = { left: 36, right: 44 };
/** As in the style of sliders. */
const HALF_THUMB_PX = 8;

const roomBeside = (element: HTMLElement, slider: HTMLElement | null): Room => {
  const graph = element.getBoundingClientRect();
  const track = slider?.getBoundingClientRect() ?? graph;
  return {
    left: Math.max(LEAST_ROOM.left, track.left + HALF_THUMB_PX - graph.left),
    right: Math.max(LEAST_ROOM.right, graph.right - track.right + HALF_THUMB_PX),
  };
};

const makePlot = (
  element: HTMLElement,
  trajectory: Trajectory,
  room: () => Room,
  momentS: () => number | null,
  onSeek: (tS: number) => void,
): UPlot => {
  const style = getComputedStyle(element);
  const color = (name: string): string => style.getPropertyValue(name).trim();
  const grid = { stroke: color("--line"), width: 1 };
  const axis = {
    stroke: color("--text-soft"),
    grid,
    ticks: { show: false },
    font: DESK_FONT,
  };
  const sample = (fromS: number, toS: number): UPlot.AlignedData => {
    const { tS, speedMmPerS, accelMmPerS2 } = graphData(
      trajectory,
      fromS,
      toS,
      Math.max(200, element.clientWidth),
    );
    return [tS, speedMmPerS, accelMmPerS2];
  };
  let pressedAtPx = 0;
  return new UPlot(
    {
      width: element.clientWidth,
      height: HEIGHT_PX,
      padding: [8, 0, 0, 0],
      legend: { show: false },
      cursor: { points: { size: 6 }, drag: { x: true, y: false, setScale: false } },
      scales: { x: { time: false }, speed: { range: fromZero }, accel: { range: fromZero } },
      axes: [
        { ...axis, size: 22, values: (_plot, splits) => splits.map((tS) => formatMoment(tS)) },
        {
          ...axis,
          scale: "speed",
          size: () => room().left,
          values: (_plot, splits) => splits.map((v) => formatNumber(v, 0)),
        },
        {
          ...axis,
          scale: "accel",
          side: 1,
          size: () => room().right,
          grid: { show: false },
          values: (_plot, splits) => splits.map((v) => formatNumber(v, 0)),
        },
      ],
      series: [
        {},
        {
          label: words.speed,
          scale: "speed",
          stroke: color("--accent"),
          width: 1.5,
          points: { show: false },
        },
        {
          label: words.accel,
          scale: "accel",
          stroke: color("--desk-accent"),
          width: 1,
          alpha: 0.65,
          points: { show: false },
        },
      ],
      hooks: {
        draw: [(plot) => drawMoment(plot, momentS(), color("--text"))],
        setSelect: [
          (plot) => {
            if (plot.select.width < 4) return;
            const fromS = plot.posToVal(plot.select.left, "x");
            const toS = plot.posToVal(plot.select.left + plot.select.width, "x");
            plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
            plot.setData(sample(Math.max(0, fromS), Math.min(trajectory.totalS, toS)));
          },
        ],
        ready: [
          (plot) => {
            plot.over.addEventListener("mousedown", (event) => (pressedAtPx = event.offsetX));
            plot.over.addEventListener("click", (event) => {
              if (Math.abs(event.offsetX - pressedAtPx) < 4) onSeek(plot.posToVal(event.offsetX, "x"));
            });
            plot.over.addEventListener("dblclick", () => plot.setData(sample(0, trajectory.totalS)));
          },
        ],
      },
    },
    sample(0, trajectory.totalS),
    element,
  );
};

const fromZero = (_plot: UPlot, _min: number, max: number): [number, number] => [0, Math.max(1, max * 1.08)];

const drawMoment = (plot: UPlot, tS: number | null, color: string): void => {
  if (tS === null) return;
  const x = Math.round(plot.valToPos(tS, "x", true));
  const { left, top, width, height } = plot.bbox;
  if (x < left || x > left + width) return;
  plot.ctx.save();
  plot.ctx.fillStyle = color;
  plot.ctx.fillRect(x, top, Math.max(1, devicePixelRatio), height);
  plot.ctx.restore();
};

interface GraphData {
  readonly tS: Float64Array;
  readonly speedMmPerS: Float64Array;
  readonly accelMmPerS2: Float64Array;
}

/** A point of the graph shows the maximum of this many samples, so that peaks are not lost. */
const SAMPLES_PER_POINT = 4;

/** `count` points from `fromS` to `toS`. O(count log blocks). */
export const graphData = (trajectory: Trajectory, fromS: number, toS: number, count: number): GraphData => {
  const tS = new Float64Array(count);
  const speedMmPerS = new Float64Array(count);
  const accelMmPerS2 = new Float64Array(count);
  const state = stateAt(trajectory, fromS);
  const step = (toS - fromS) / Math.max(1, count - 1);
  for (let i = 0; i < count; i++) {
    tS[i] = fromS + i * step;
    for (let k = 0; k < SAMPLES_PER_POINT; k++) {
      stateAt(trajectory, Math.min(toS, tS[i] + (k / SAMPLES_PER_POINT) * step), state);
      speedMmPerS[i] = Math.max(speedMmPerS[i], Math.hypot(state.vx, state.vy));
      accelMmPerS2[i] = Math.max(accelMmPerS2[i], Math.hypot(state.ax, state.ay));
    }
  }
  return { tS, speedMmPerS, accelMmPerS2 };
};
