import { useMemo, type ReactNode } from "react";
import { OVERLAP_TABLE, PEN_TABLE } from "../../../src/internal.js";
import { activeJob, currentPlotter, otherOperator, type PageState } from "../../state/store.js";
import { useActions, usePageState } from "../../state/use-store.js";
import { useIsUsed } from "../../state/used-settings.js";
import { Button } from "../../ui/button.js";
import { SettingField } from "../../ui/fields/setting-field.js";
import { usePenChange } from "../../ui/use-change.js";
import { servoFollower } from "./servo-follow.js";
import { penText as words } from "../text.js";

/**
 * Whether the pen can follow the slider. While the pen moves, the plotter is briefly busy, and the slider still
 * works.
 */
const mayFollow = (state: PageState): boolean => {
  const connection = currentPlotter(state)?.connection;
  return (
    state.link === "connected" &&
    activeJob(state) === null &&
    (connection === "idle" || connection === "busy")
  );
};

interface HeightsProps {
  /** The height at which the tip touches can be set, too. */
  readonly hasContact?: boolean;
  /** The pen was moved. */
  onTry?(): void;
}

/** The heights of the pen, which follows their sliders. */
export const Heights = ({ hasContact, onTry }: HeightsProps) => {
  const pen = usePageState((state) => state.settings.pen);
  const isFollowing = usePageState(mayFollow);
  // If another browser is the operator, storing the heights asks to take over first.
  const isOthers = usePageState((state) => otherOperator(state) !== null);
  const isContactUsed = useIsUsed("pen.contactPct");
  const { movePen } = useActions();
  const change = usePenChange();
  const follow = useMemo(
    () => servoFollower(({ isUp, pct }: { isUp: boolean; pct: number }) => movePen(isUp, pct)),
    [movePen],
  );
  const row = (which: "upPct" | "downPct"): ReactNode => (
    <div className="field-with-button">
      <SettingField
        setting={PEN_TABLE[which]}
        value={pen[which]}
        onChange={(pct) => change({ [which]: pct })}
        onSlide={(pct) => {
          onTry?.();
          if (isFollowing && !isOthers) follow({ isUp: which === "upPct", pct });
        }}
      />
      <Button
        disabled={!isFollowing}
        onClick={() => {
          onTry?.();
          follow({ isUp: which === "upPct", pct: pen[which] });
        }}
      >
        {which === "upPct" ? words.up : words.down}
      </Button>
    </div>
  );
  const touch = (contactPct: number): void => {
    onTry?.();
    const pct = pen.downPct + ((pen.upPct - pen.downPct) * contactPct) / 100;
    if (isFollowing) follow({ isUp: false, pct });
  };
  return (
    <div className="pen-heights">
      {row("upPct")}
      {row("downPct")}
      {hasContact && isContactUsed && pen.overlap !== "off" && (
        <>
          <div className="field-with-button">
            <SettingField
              setting={OVERLAP_TABLE.contactPct}
              value={pen.contactPct}
              onChange={(contactPct) => change({ contactPct })}
              onSlide={touch}
            />
            <Button disabled={!isFollowing} onClick={() => touch(pen.contactPct)}>
              {words.touch}
            </Button>
          </div>
          <p className="note">{words.touchHint}</p>
        </>
      )}
    </div>
  );
};
