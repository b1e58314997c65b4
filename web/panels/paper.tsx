import { PAPER_SIZES, type PaperName } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { useActions, usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { Segments, Select, Switch } from "../ui/choice.js";
import { formatNumber } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { NumberField } from "../ui/number-field.js";
import { placeOfFrame } from "../preview/placing.js";
import { SettingsGroup } from "./settings-group.js";

const words = text.paper;
type PrepareSettings = PlotSettings["prepare"];
const PAPER_NAMES = Object.keys(PAPER_SIZES) as PaperName[];
const CUSTOM = "custom";

const nameOfPaper = ({ widthMm, heightMm }: PrepareSettings["paper"]): PaperName | typeof CUSTOM =>
  PAPER_NAMES.find(
    (name) => PAPER_SIZES[name].widthMm === widthMm && PAPER_SIZES[name].heightMm === heightMm,
  ) ?? CUSTOM;

/** A change of the prepare settings that undo knows by `what`. */
export const usePrepareChange = () => {
  const { changeSettings } = useActions();
  return (what: string, change: Partial<PrepareSettings>): void =>
    changeSettings(what, (settings) => ({ ...settings, prepare: { ...settings.prepare, ...change } }));
};

export const PaperPanel = () => {
  const prepare = usePageState((state) => state.settings.prepare);
  const change = usePrepareChange();
  const { paper, landscape, marginMm, rotateDeg } = prepare;
  const frame = usePageState((state) => state.planned?.frameMm ?? null);
  const firstPlace = placeOfFrame(frame ?? { xMm: marginMm, yMm: marginMm, widthMm: 100, heightMm: 100 });
  const name = nameOfPaper(paper);
  const size = landscape
    ? `${formatNumber(paper.heightMm, 1)} × ${formatNumber(paper.widthMm, 1)}`
    : `${formatNumber(paper.widthMm, 1)} × ${formatNumber(paper.heightMm, 1)}`;

  return (
    <SettingsGroup id="paper" title={words.title} summary={`${name === CUSTOM ? "" : `${name}, `}${size} mm`}>
      <Select
        label={words.size}
        value={name}
        options={[
          ...PAPER_NAMES.map((value) => ({ value, label: value.replace("in", " in").replace("x", " × ") })),
          { value: CUSTOM, label: words.custom },
        ]}
        onChange={(value) => {
          // A size of one's own begins a hair beside the named one, so that its fields show.
          if (value !== CUSTOM) change("paper", { paper: PAPER_SIZES[value] });
          else change("paper", { paper: { ...paper, widthMm: paper.widthMm + 1 } });
        }}
      />
      {name === CUSTOM && <CustomSize paper={paper} change={change} />}
      <Segments
        label={words.orientation}
        value={landscape ? "landscape" : "portrait"}
        options={[
          { value: "portrait", label: words.portrait },
          { value: "landscape", label: words.landscape },
        ]}
        onChange={(value) => change("orientation", { landscape: value === "landscape" })}
      />
      {!prepare.margins && (
        <NumberField
          label={words.margin}
          value={marginMm}
          unit="mm"
          min={0}
          max={Math.floor(Math.min(paper.widthMm, paper.heightMm) / 2) - 1}
          step={1}
          slider={[0, 60]}
          onChange={(value) => change("margin", { marginMm: value })}
        />
      )}
      <Margins prepare={prepare} change={change} />
      <Segments
        label={words.placement}
        value={prepare.place ? "place" : prepare.fit ? "fit" : "true"}
        options={[
          { value: "fit", label: words.fit },
          { value: "true", label: words.trueSize },
          { value: "place", label: words.byNumbers },
        ]}
        onChange={(value) =>
          change("fit", value === "place" ? { place: firstPlace } : { fit: value === "fit", place: null })
        }
      />
      {prepare.place && <PlaceFields place={prepare.place} change={change} />}
      <div className="field-with-button">
        <NumberField
          label={words.rotate}
          value={rotateDeg}
          unit="°"
          min={-360}
          max={360}
          step={1}
          onChange={(value) => change("rotate", { rotateDeg: value })}
        />
        <button
          type="button"
          className="button button-icon"
          title={words.rotateQuarter}
          aria-label={words.rotateQuarter}
          onClick={() => change("quarter", { rotateDeg: (rotateDeg + 90) % 360 })}
        >
          <Icon name="again" />
        </button>
      </div>
      <Segments
        label={words.mirror}
        value={prepare.mirror}
        options={[
          { value: "none", label: words.mirrors.none },
          { value: "leftRight", label: words.mirrors.leftRight },
          { value: "upDown", label: words.mirrors.upDown },
        ]}
        onChange={(mirror) => change("mirror", { mirror })}
      />
      <Switch
        label={words.cropToPage}
        isOn={prepare.cropToPage}
        onChange={(cropToPage) => change("crop", { cropToPage })}
      />
      <Switch
        label={words.clip}
        isOn={prepare.clipToMargins}
        onChange={(clipToMargins) => change("clip", { clipToMargins })}
      />
    </SettingsGroup>
  );
};

interface CustomSizeProps {
  readonly paper: PrepareSettings["paper"];
  change(what: string, change: Partial<PrepareSettings>): void;
}

const CustomSize = ({ paper, change }: CustomSizeProps) => (
  <div className="field-pair">
    <NumberField
      label={words.width}
      value={paper.widthMm}
      unit="mm"
      min={10}
      max={5_000}
      step={1}
      onChange={(widthMm) => change("paper width", { paper: { ...paper, widthMm } })}
    />
    <NumberField
      label={words.height}
      value={paper.heightMm}
      unit="mm"
      min={10}
      max={5_000}
      step={1}
      onChange={(heightMm) => change("paper height", { paper: { ...paper, heightMm } })}
    />
  </div>
);

interface PartProps {
  readonly prepare: PrepareSettings;
  change(what: string, change: Partial<PrepareSettings>): void;
}

const SIDES = ["topMm", "rightMm", "bottomMm", "leftMm"] as const;
const SIDE_WORDS = { topMm: words.top, rightMm: words.right, bottomMm: words.bottom, leftMm: words.left };

const Margins = ({ prepare: { margins, marginMm }, change }: PartProps) => (
  <>
    <Switch
      label={words.margins}
      isOn={margins !== null}
      onChange={(isOn) =>
        change("four margins", {
          margins: isOn ? { topMm: marginMm, rightMm: marginMm, bottomMm: marginMm, leftMm: marginMm } : null,
        })
      }
    />
    {margins && (
      <div className="field-pair">
        {SIDES.map((side) => (
          <NumberField
            key={side}
            label={SIDE_WORDS[side]}
            value={margins[side]}
            unit="mm"
            min={0}
            max={1_000}
            step={1}
            onChange={(value) => change(`margin ${side}`, { margins: { ...margins, [side]: value } })}
          />
        ))}
      </div>
    )}
  </>
);

interface PlaceFieldsProps {
  readonly place: NonNullable<PrepareSettings["place"]>;
  change(what: string, change: Partial<PrepareSettings>): void;
}

/** Where the drawing stands and how large; its proportions stay, so one of the sizes decides. */
const PlaceFields = ({ place, change }: PlaceFieldsProps) => {
  const frame = usePageState((state) => state.planned?.frameMm ?? null);
  const set = (part: Partial<typeof place>): void =>
    change(`place ${Object.keys(part).join()}`, { place: { ...place, ...part } });
  const fields = [
    ["xMm", words.x, place.xMm, -10_000],
    ["yMm", words.y, place.yMm, -10_000],
    ["widthMm", words.width, place.widthMm ?? frame?.widthMm ?? 0, 0.1],
    ["heightMm", words.height, place.heightMm ?? frame?.heightMm ?? 0, 0.1],
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
      <p className="note">{words.placeHint}</p>
    </>
  );
};
