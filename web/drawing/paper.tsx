import { PAPER_SIZES } from "../../src/index.js";
import {
  LENGTH_UNITS,
  orientedPaper,
  PAPER_TABLE,
  PREPARE_TABLE,
  tileCount,
  type PaperName,
} from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { PageState } from "../state/store.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import { paperText as words, tilesText } from "./text.js";
import { Button, IconButton } from "../ui/button.js";
import { Segments, Select, Switch } from "../ui/fields/choice.js";
import { formatSize } from "../ui/format.js";
import { SettingField } from "../ui/fields/setting-field.js";
import { layoutOfFrame, wholeTurn } from "../scene/placing.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/fields/settings-group.js";
import { Panel } from "../ui/panel.js";
import { usePrepareChange } from "../ui/use-change.js";

const TilesFields = lazyPart(async () => (await import("./tiles-fields.js")).TilesFields);
const LayoutFields = lazyPart(async () => (await import("./layout-fields.js")).LayoutFields);
type PrepareSettings = PlotSettings["prepare"];
const PAPER_NAMES = Object.keys(PAPER_SIZES) as PaperName[];
const FIT_NAMES = { auto: "auto", true: "fit", false: "true" } as const;
const FITS = {
  auto: { fit: "auto", rotateDeg: "auto" },
  fit: { fit: true },
  true: { fit: false },
} as const;
const CUSTOM = "custom";
/** What lies outside the paper is not moved by a setting, where each drawing has its place. */
const ON_SHEET = ["refuse", "cut", "allow"] as const;

const nameOfPaper = ({ widthMm, heightMm }: PrepareSettings["paper"]): PaperName | typeof CUSTOM =>
  PAPER_NAMES.find(
    (name) => PAPER_SIZES[name].widthMm === widthMm && PAPER_SIZES[name].heightMm === heightMm,
  ) ?? CUSTOM;

/** The paper's sides have fields. */
export const isCustomPaper = ({ settings: { prepare }, typedPaper }: PageState): boolean =>
  prepare.paper === typedPaper || nameOfPaper(prepare.paper) === CUSTOM;

export const paperLabel = (name: PaperName): string => name.replace("in", " in").replace("x", " × ");

export const PaperPanel = () => {
  const prepare = usePageState((state) => state.settings.prepare);
  /** Each drawing has its place. */
  const isSheet = usePageState(({ drawing }) => Boolean(drawing?.sheet));
  const lengthUnit = usePageState((state) => state.view.lengthUnit);
  const change = usePrepareChange();
  const { changeView } = useActions();
  const { paper, landscape, marginMm } = prepare;
  const choiceDeg = usePageState((state) => state.planned?.choice.rotateDeg ?? 0);
  const rotateDeg = prepare.rotateDeg === "auto" ? choiceDeg : prepare.rotateDeg;
  const frame = usePageState((state) => state.planned?.frameMm ?? null);
  const firstLayout = layoutOfFrame(
    frame ?? { xMm: marginMm, yMm: marginMm, widthMm: 100, heightMm: 100, turnDeg: 0 },
  );
  const angleDeg = wholeTurn(rotateDeg + (prepare.layout?.turnDeg ?? 0));
  // A drawing placed by hand turns around its centre and keeps its size.
  const turnTo = (what: string, deg: number): void =>
    change(
      what,
      prepare.layout
        ? { layout: { ...prepare.layout, turnDeg: wholeTurn(deg - rotateDeg) } }
        : { rotateDeg: wholeTurn(deg) },
    );
  const store = usePageStore();
  const isCustom = usePageState(isCustomPaper);
  const name = nameOfPaper(paper);
  const { widthMm, heightMm } = orientedPaper(paper, landscape);
  const size = formatSize(widthMm, heightMm, lengthUnit);

  return (
    <Panel id="paper" title={words.title} summary={`${name === CUSTOM ? "" : `${name}, `}${size}`}>
      <Select
        label={words.size}
        value={isCustom ? CUSTOM : name}
        options={[
          ...PAPER_NAMES.map((value) => ({ value, label: paperLabel(value) })),
          { value: CUSTOM, label: words.custom },
        ]}
        onChange={(value) => {
          store.setState({ typedPaper: value === CUSTOM ? paper : null });
          if (value !== CUSTOM) change("paper", { paper: PAPER_SIZES[value] });
        }}
      />
      {isCustom && <CustomSize prepare={prepare} />}
      <Segments
        label={words.orientation}
        isInline
        value={landscape ? "landscape" : "portrait"}
        options={[
          { value: "portrait", label: words.portrait },
          { value: "landscape", label: words.landscape },
        ]}
        onChange={(value) => change("orientation", { landscape: value === "landscape" })}
      />
      {!prepare.margins && (
        <SettingField
          setting={PREPARE_TABLE.marginMm}
          value={marginMm}
          max={Math.floor(Math.min(paper.widthMm, paper.heightMm) / 2) - 1}
          onChange={(value) => change("margin", { marginMm: value })}
        />
      )}
      {isSheet ? (
        <p className="note">{words.onSheet}</p>
      ) : (
        <>
          <Segments
            label={words.placement}
            value={prepare.layout ? "box" : FIT_NAMES[`${prepare.fit}`]}
            hint={words.autoHint}
            options={[
              { value: "auto", label: words.auto },
              { value: "fit", label: words.fit },
              { value: "true", label: words.trueSize },
              { value: "box", label: words.byNumbers },
            ]}
            onChange={(value) =>
              change("fit", value === "box" ? { layout: firstLayout } : { ...FITS[value], layout: null })
            }
          />
          {prepare.layout && <LayoutFields layout={prepare.layout} />}
          <Resolution prepare={prepare} />
          <div className="field-with-button">
            <SettingField
              setting={PREPARE_TABLE.rotateDeg}
              value={angleDeg}
              onChange={(value) => turnTo("rotate", value)}
            />
            <IconButton
              kind="icon"
              icon="again"
              label={words.rotateQuarter}
              onClick={() => turnTo("quarter", angleDeg + 90)}
            />
          </div>
          {prepare.rotateDeg !== "auto" && !prepare.layout && prepare.fit !== true && (
            <Button kind="link" onClick={() => change("rotate", { rotateDeg: "auto" })}>
              {words.autoTurn}
            </Button>
          )}
        </>
      )}
      <Segments
        label={words.unit}
        isInline
        value={lengthUnit}
        options={LENGTH_UNITS.map((value) => ({ value, label: words.units[value] }))}
        onChange={(unit) => changeView({ lengthUnit: unit })}
      />
      <SettingsGroup
        id="tiles"
        isPart
        isLazy
        title={tilesText.title}
        summary={
          tileCount(prepare) > 1 ? tilesText.summary(prepare.tileColumns, prepare.tileRows) : undefined
        }
      >
        <TilesFields />
      </SettingsGroup>
      <SettingsGroup id="paper-more" isPart title={words.more}>
        <Margins prepare={prepare} />
        {!isSheet && (
          <Segments
            label={PREPARE_TABLE.mirror.label}
            value={prepare.mirror}
            options={PREPARE_TABLE.mirror.choices.map((value) => ({ value, label: words.mirrors[value] }))}
            onChange={(mirror) => change("mirror", { mirror })}
          />
        )}
        <Select
          label={PREPARE_TABLE.outside.label}
          isBelow
          value={prepare.outside}
          options={(isSheet ? ON_SHEET : PREPARE_TABLE.outside.choices).map((value) => ({
            value,
            label: words.outside[value],
          }))}
          onChange={(outside) => change("outside", { outside })}
        />
        {!isSheet && (
          <Switch
            label={PREPARE_TABLE.cropToPage.label}
            isOn={prepare.cropToPage}
            onChange={(cropToPage) => change("crop", { cropToPage })}
          />
        )}
        <Switch
          label={PREPARE_TABLE.clipToMargins.label}
          isOn={prepare.clipToMargins}
          onChange={(clipToMargins) => change("clip", { clipToMargins })}
        />
      </SettingsGroup>
    </Panel>
  );
};

/** For a file whose page is given in px. */
const Resolution = ({ prepare }: { prepare: PrepareSettings }) => {
  const pxPerInch = usePageState((state) => state.planned?.pxPerInch ?? null);
  const change = usePrepareChange();
  if (pxPerInch === null) return null;
  return (
    <>
      <SettingField
        setting={PREPARE_TABLE.pxPerInch}
        value={prepare.pxPerInch === "auto" ? pxPerInch : prepare.pxPerInch}
        onChange={(value) => change("resolution", { pxPerInch: value })}
      />
      {prepare.pxPerInch !== "auto" && (
        <Button kind="link" onClick={() => change("resolution", { pxPerInch: "auto" })}>
          {words.guessPx}
        </Button>
      )}
    </>
  );
};

/** The size as the paper lies. It is stored in portrait, so the longer side decides the orientation. */
const CustomSize = ({ prepare: { paper, landscape } }: { prepare: PrepareSettings }) => {
  const change = usePrepareChange();
  const { widthMm, heightMm } = orientedPaper(paper, landscape);
  const store = usePageStore();
  const resize = (what: string, width: number, height: number): void => {
    const typedPaper = { widthMm: Math.min(width, height), heightMm: Math.max(width, height) };
    store.setState({ typedPaper });
    change(what, { paper: typedPaper, landscape: width === height ? landscape : width > height });
  };
  return (
    <div className="field-pair">
      <SettingField
        setting={PAPER_TABLE.widthMm}
        value={widthMm}
        onChange={(width) => resize("paper width", width, heightMm)}
      />
      <SettingField
        setting={PAPER_TABLE.heightMm}
        value={heightMm}
        onChange={(height) => resize("paper height", widthMm, height)}
      />
    </div>
  );
};

const SIDES = ["topMm", "rightMm", "bottomMm", "leftMm"] as const;
const SIDE_WORDS = { topMm: words.top, rightMm: words.right, bottomMm: words.bottom, leftMm: words.left };

const Margins = ({ prepare: { margins, marginMm } }: { prepare: PrepareSettings }) => {
  const change = usePrepareChange();
  return (
    <>
      <Switch
        label={words.margins}
        isOn={margins !== null}
        onChange={(isOn) =>
          change("four margins", {
            margins: isOn
              ? { topMm: marginMm, rightMm: marginMm, bottomMm: marginMm, leftMm: marginMm }
              : null,
          })
        }
      />
      {margins && (
        <div className="field-pair">
          {SIDES.map((side) => (
            <SettingField
              key={side}
              setting={{ ...PREPARE_TABLE.marginMm, label: SIDE_WORDS[side] }}
              value={margins[side]}
              onChange={(value) => change(`margin ${side}`, { margins: { ...margins, [side]: value } })}
            />
          ))}
        </div>
      )}
    </>
  );
};
