import type { ReactNode } from "react";
import { findMachine } from "../../src/internal.js";
import type { Plotter } from "../../src/schema/index.js";
import { activeJob, currentPlotter, mayOperate } from "../state/store.js";
import { useBackend, useIsConnected, usePageState } from "../state/use-store.js";
import { plotterText as words, presetsText } from "./text.js";
import { ActionButton } from "../ui/action-button.js";
import { Facts } from "../ui/facts.js";
import { formatFixed } from "../ui/format.js";
import { lazyPart } from "../ui/lazy-part.js";
import { PenAtHand, StopMove } from "./hand/pen-at-hand.js";
import { ModelSelect } from "./model-select.js";
import { adviceWords, homeWords, lampOf, penWords, plotterWords } from "./machine-words.js";
import { CONNECT, CONSOLE, MACHINES_DIALOG, RINGING, SAVE_LOG, SET_UP } from "./plotter-actions.js";
import { SettingsGroup } from "../ui/fields/settings-group.js";

const FindPlotter = lazyPart(async () => (await import("./find-plotter.js")).FindPlotter);
const HandMoves = lazyPart(async () => (await import("./hand/hand-moves.js")).HandMoves);

const isSought = ({ kind, connection }: Plotter): boolean =>
  kind === "virtual" || connection === "absent" || connection === "fault";

/** The plotter's state, and the controls that every plot needs. `children`: shown before them, from other features. */
export const MachinePanel = ({ children }: { children?: ReactNode }) => {
  const plotter = usePageState(currentPlotter);
  const isMine = usePageState(mayOperate);
  const { features } = useBackend();
  return (
    <section className="card" aria-label={words.title}>
      <h2 className="card-title">{words.title}</h2>
      {plotter && <PlotterName plotter={plotter} />}
      <ActionButton action={CONNECT} />
      {isMine && plotter && (features.sharing ? isSought(plotter) : plotter.otherBoard) && (
        <FindPlotter plotter={plotter} />
      )}
      {isMine && children}
      {isMine ? <PenAtHand /> : <StopMove />}
    </section>
  );
};

/** Controls that are needed less often. `children`: the pen-lift settings, from `web/pens`. */
export const MachineSetUp = ({ children }: { children: ReactNode }) => {
  const plotter = usePageState(currentPlotter);
  const isMine = usePageState(mayOperate);
  const home = usePageState(({ settings }) => homeWords(findMachine(settings)));
  return (
    <section className="card machine-set-up" aria-label={words.rest}>
      <div className="group-in-card">
        {isMine && (
          <SettingsGroup id="moves" isLazy title={words.moves}>
            <HandMoves />
          </SettingsGroup>
        )}
        {isMine && children}
        <SettingsGroup id="plotter" title={words.more}>
          {isMine && <ModelSelect label={words.model} />}
          {plotter && <PlotterFacts plotter={plotter} />}
          <p className="note">{home}</p>
        </SettingsGroup>
      </div>
      <p className="link-row">
        {[SET_UP, MACHINES_DIALOG, RINGING, CONSOLE, SAVE_LOG].map((action) => (
          <ActionButton key={action.id} action={action} kind="link" />
        ))}
      </p>
    </section>
  );
};

const PlotterName = ({ plotter }: { plotter: Plotter }) => {
  const job = usePageState(activeJob);
  const isConnected = useIsConnected();
  const model = usePageState(({ settings }) => findMachine(settings)?.name ?? null);
  const { boardName } = plotter;
  // Under the title "Plotter", that name would say nothing.
  const name = plotter.name === words.title ? (boardName ?? model) : plotter.name;
  return (
    <>
      <p className="plotter-name" data-lamp={isConnected ? lampOf(plotter, job) : "fault"}>
        <span className="lamp" aria-hidden="true" />
        <strong>{name}</strong>
        {boardName !== null && boardName !== name && <span className="note">({boardName})</span>}
        <span className="plotter-doing">{isConnected ? plotterWords(plotter, job) : words.notHeard}</span>
      </p>
      <PlotterMessage plotter={plotter} />
    </>
  );
};

const PlotterFacts = ({ plotter }: { plotter: Plotter }) => {
  const advice = usePageState(({ settings }) => adviceWords(plotter, findMachine(settings)));
  const { xMm, yMm } = plotter;
  const place =
    xMm === null || yMm === null ? words.unknown : `${formatFixed(xMm, 1)}, ${formatFixed(yMm, 1)} mm`;
  return (
    <>
      <Facts
        className="facts"
        rows={[
          [words.position, place],
          [words.pen, penWords(plotter)],
          [words.motors, plotter.motorsOn === null ? words.unknown : plotter.motorsOn ? words.on : words.off],
          [words.firmware, plotter.firmware ?? words.unknown],
        ]}
      />
      {advice !== null && <p className="note">{advice}</p>}
    </>
  );
};

const PlotterMessage = ({ plotter: { connection, kind, message } }: { plotter: Plotter }) => {
  const { features } = useBackend();
  if (message && (connection === "fault" || connection === "absent")) {
    return (
      <p className="note health" role="alert">
        {message}
      </p>
    );
  }
  if (kind === "virtual") {
    const hint = features.asksForPort ? words.connectHint : words.virtualHint;
    return <p className="note">{features.whyNoPort ?? hint}</p>;
  }
  return message ? <p className="note">{message}</p> : null;
};

const PresetList = lazyPart(async () => (await import("./preset-list.js")).PresetList);

export const PresetsPanel = () => {
  const count = usePageState((state) => state.presets.length);
  return (
    <SettingsGroup id="presets" isLazy title={presetsText.title} summary={count > 0 ? String(count) : ""}>
      <PresetList />
    </SettingsGroup>
  );
};
