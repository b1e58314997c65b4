/** The parts of which the view modes make their legends. */
import { rampColor } from "../../../src/internal.js";
import { formatNumber } from "../../ui/format.js";
import { previewText as words } from "../text.js";

const GRADIENT_STOPS = 16;
const GRADIENT = `linear-gradient(90deg, ${Array.from({ length: GRADIENT_STOPS + 1 }, (_, i) =>
  rampColor(i / GRADIENT_STOPS),
).join(", ")})`;

interface RampProps {
  readonly title: string;
  readonly unit?: string;
  /** From the beginning of the ramp to its end. */
  readonly labels: readonly string[];
}

/** The colour ramp, and what it means. */
export const Ramp = ({ title, unit, labels }: RampProps) => (
  <>
    <figcaption>
      <span>{title}</span>
      {unit && <span>{unit}</span>}
    </figcaption>
    <div className="legend-scale">
      <div className="legend-bar" style={{ background: GRADIENT }} />
      <div className="legend-labels">
        {labels.map((label, i) => (
          <span key={i}>{label}</span>
        ))}
      </div>
    </div>
  </>
);

const LABELS = 5;

/** Evenly spaced numbers. */
export const scaleLabels = (from: number, to: number, digits: number): string[] =>
  Array.from({ length: LABELS }, (_, i) => formatNumber(from + ((to - from) * i) / (LABELS - 1), digits));

interface LegendEntry {
  readonly color: string;
  readonly label: string;
}

const SHOWN_ENTRIES = 6;

/** Colours with names, each once. */
export const ListLegend = ({ title, entries }: { title: string; entries: readonly LegendEntry[] }) => {
  const keyOf = ({ color, label }: LegendEntry): string => `${color} ${label}`;
  const different = [...new Map(entries.map((entry) => [keyOf(entry), entry]))];
  const restCount = different.length - SHOWN_ENTRIES;
  return (
    <figure className="legend legend-rows">
      <figcaption>{title}</figcaption>
      {/* On a phone it is one line, which scrolls. */}
      <ul className="legend-list" tabIndex={0}>
        {different.slice(0, SHOWN_ENTRIES).map(([key, { color, label }]) => (
          <li key={key}>
            <span className="swatch" style={{ backgroundColor: color }} />
            {label}
          </li>
        ))}
        {restCount > 0 && <li>{words.moreEntries(restCount)}</li>}
      </ul>
    </figure>
  );
};
