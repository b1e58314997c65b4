import type { OutsidePaper as Outside } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { wholeTurn } from "../scene/placing.js";
import { isOutsideUnanswered } from "./where-drawn.js";
import { useActions, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { Icon } from "../ui/icon.js";
import { formatCount, formatInUnit } from "../ui/format.js";
import { usePrepareChange } from "../ui/use-change.js";
import type { Planned } from "../worker/protocol.js";
import { outsideText as words } from "./text.js";

type Prepare = PlotSettings["prepare"];

/** What lies outside the paper, and the choices. */
export const OutsidePaper = () => {
  const planned = usePageState((state) => state.planned);
  const isUnanswered = usePageState(isOutsideUnanswered);
  const unit = usePageState((state) => state.view.lengthUnit);
  const isSheet = usePageState(({ drawing }) => Boolean(drawing?.sheet));
  const change = usePrepareChange();
  const { moveOntoPaper, fitSheet } = useActions();
  if (!planned?.outside || !planned.outsideChoices) return null;
  const { outside } = planned;
  const { turn, canCut, canMove, canAllow } = planned.outsideChoices;
  const edges = EDGES.filter((edge) => outside[edge] > 0).map((edge) =>
    words.edges[edge](`${formatInUnit(outside[edge], unit, 1)}\u202f${unit}`),
  );
  const leaves = words.leaves(outside.strokeCount, formatCount(outside.strokeCount), edges.join(words.and));
  if (!isUnanswered) return <p className="note cut-off-note">{`${leaves} ${words.isAllowed}`}</p>;
  return (
    <div className="outside-strip" role="group" aria-label={words.choices}>
      <p>
        <Icon name="warning" />
        {leaves}
      </p>
      <div className="outside-choices">
        {turn && <Button onClick={() => change("outside", turn)}>{words.turn}</Button>}
        {canCut && (
          <Button title={words.cutHint} onClick={() => change("outside", { outside: "cut" })}>
            {words.cut}
          </Button>
        )}
        {canMove && (
          <Button
            onClick={() => (isSheet ? void moveOntoPaper() : change("outside", movedBack(planned, outside)))}
          >
            {words.move}
          </Button>
        )}
        <Button
          title={words.fitHint}
          onClick={() => (isSheet ? void fitSheet() : change("outside", fittedTo(planned)))}
        >
          {words.fit}
        </Button>
        {canAllow && (
          <Button kind="link" onClick={() => change("outside", { outside: "allow" })}>
            {words.allow}
          </Button>
        )}
      </div>
    </div>
  );
};

const EDGES = ["leftMm", "topMm", "rightMm", "bottomMm"] as const;

/** A drawing that was placed by hand gets another place, so that its frame is where it is drawn. */
export const movedBack = (
  { settings }: Pick<Planned, "settings">,
  { leftMm, topMm, rightMm, bottomMm }: Outside,
): Partial<Prepare> => {
  const { layout } = settings.prepare;
  if (!layout) return { outside: "move" };
  return { layout: { ...layout, xMm: layout.xMm + leftMm - rightMm, yMm: layout.yMm + topMm - bottomMm } };
};

/** Keeps the angle of a drawing that was placed by hand. */
export const fittedTo = ({ settings, choice }: Pick<Planned, "settings" | "choice">): Partial<Prepare> => {
  const { layout } = settings.prepare;
  return {
    fit: true,
    layout: null,
    ...(layout ? { rotateDeg: wholeTurn(choice.rotateDeg + (layout.turnDeg ?? 0)) } : {}),
  };
};
