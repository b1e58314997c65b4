import { QUALITIES, qualityOf, withQuality, type Quality } from "../../src/internal.js";

import { useIsUsed } from "../state/used-settings.js";
import { useActions, usePageState } from "../state/use-store.js";
import { motionText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { Segments } from "../ui/fields/choice.js";
import { formatInUnit, formatNumber } from "../ui/format.js";
import { lazyPart } from "../ui/lazy-part.js";
import { SettingsGroup } from "../ui/fields/settings-group.js";
import { Panel } from "../ui/panel.js";
import { useSprings } from "./use-springs.js";

const MotionDetails = lazyPart(async () => (await import("./motion-details.js")).MotionDetails);

/** Speed, acceleration and corners as three qualities. The numbers behind them are folded. */
export const MotionPanel = () => {
  const motion = usePageState((state) => state.settings.motion);
  const springs = useSprings();
  const isPlannedHere = useIsUsed("motion.mode");
  const chosen = qualityOf(motion, springs) ?? "custom";
  const summary = `${words.qualities[chosen]}, ${formatNumber(motion.draw.speedMmPerS)} mm/s`;
  return (
    <Panel id="motion" title={words.title} summary={summary}>
      {isPlannedHere && (
        <>
          <QualityChoice chosen={chosen} />
          <Swing />
        </>
      )}
      <SettingsGroup id="motion-details" isPart isLazy title={words.details}>
        <MotionDetails />
      </SettingsGroup>
    </Panel>
  );
};

const QualityChoice = ({ chosen }: { chosen: Quality | "custom" }) => {
  const { draw } = usePageState((state) => state.settings.motion);
  const lengthUnit = usePageState((state) => state.view.lengthUnit);
  const springs = useSprings();
  const { changeSettings } = useActions();
  const steps = QUALITIES.map((value) => ({
    value,
    label: words.qualities[value],
    isOff: springs === null && value !== "normal",
  }));
  const hint = springs === null && chosen === "normal" ? words.plainHint : words.hints[chosen];
  return (
    <div className="quality">
      <Segments<Quality | "custom">
        label={words.quality}
        value={chosen}
        options={chosen === "custom" ? [...steps, { value: "custom", label: words.qualities.custom }] : steps}
        onChange={(quality) => {
          if (quality === "custom") return;
          changeSettings("quality", (settings) => ({
            ...settings,
            motion: withQuality(settings.motion, quality, springs),
          }));
        }}
      />
      <p className="note">{hint}</p>
      <p className="note">
        {words.figures(
          formatNumber(draw.speedMmPerS),
          formatNumber(draw.accelMmPerS2),
          `${formatInUnit(draw.cornerMm, lengthUnit, 3)} ${lengthUnit}`,
        )}
      </p>
    </div>
  );
};

/** How the machine swings and where to see it, or why to measure it. */
const Swing = () => {
  const springs = useSprings();
  const { changeView, openDialog } = useActions();
  const note =
    springs === null
      ? words.unmeasured
      : words.measured(formatNumber(springs.xHz, 1), formatNumber(springs.yHz, 1));
  return (
    <div className="swing" data-measured={springs !== null || undefined}>
      <p className="note">{note}</p>
      <Button kind={springs === null ? "small" : "link"} onClick={() => openDialog("ringing")}>
        {springs === null ? words.measure : words.measureAgain}
      </Button>
      <Button kind="link" onClick={() => changeView({ viewMode: "swing" })}>
        {words.showSwing}
      </Button>
    </div>
  );
};
