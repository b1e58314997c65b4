import { MACHINES } from "../../src/index.js";
import type { Plotter } from "../../src/schema/index.js";
import { currentPlotter } from "../state/store.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import { text } from "../text/text.js";
import { formatFixed } from "../ui/format.js";
import { Select } from "../ui/choice.js";

const words = text.machine;

/** The machine's state in one line, with a lamp: always in sight. */
export const MachineState = () => {
  const link = usePageState((state) => state.link);
  const plotter = usePageState(currentPlotter);
  const lamp =
    link === "connected" && plotter ? plotter.connection : link === "lost" ? "fault" : "connecting";
  return (
    <p className="machine-state" role="status" data-lamp={lamp}>
      <span className="lamp" aria-hidden="true" />
      <span>{stateWords(link, plotter)}</span>
    </p>
  );
};

const stateWords = (link: string, plotter: Plotter | null): string => {
  if (link === "lost") return words.server.lost;
  if (link === "connecting" || !plotter) return words.server.connecting;
  if (plotter.kind === "virtual") return words.virtual;
  return `${plotter.name}: ${words.connection[plotter.connection]}`;
};

export const MachinePanel = () => {
  const plotter = usePageState(currentPlotter);
  return (
    <section className="card" aria-label={words.title}>
      <h2 className="card-title">{words.title}</h2>
      <PlotterSelect />
      {plotter && <PlotterFacts plotter={plotter} />}
      <ModelSelect />
      <HandControls plotter={plotter} />
      {plotter && (
        <a className="link" href={`/api/v1/plotters/${encodeURIComponent(plotter.id)}/log`} download>
          {words.log}
        </a>
      )}
      <p className="note">{words.homeHint}</p>
    </section>
  );
};

const PlotterFacts = ({ plotter }: { plotter: Plotter }) => {
  const { xMm, yMm } = plotter;
  const place =
    xMm === null || yMm === null ? words.unknown : `${formatFixed(xMm, 1)}, ${formatFixed(yMm, 1)} mm`;
  const facts = [
    [words.position, place],
    [words.pen, plotter.penUp === null ? words.unknown : plotter.penUp ? words.up : words.down],
    [words.motors, plotter.motorsOn === null ? words.unknown : plotter.motorsOn ? words.on : words.off],
    [words.firmware, plotter.firmware ?? words.unknown],
  ] as const;
  return (
    <>
      <p className="plotter-name" data-lamp={plotter.connection}>
        <span className="lamp" aria-hidden="true" />
        <strong>{plotter.name}</strong>
        <span>{words.connection[plotter.connection]}</span>
      </p>
      <PlotterMessage plotter={plotter} />
      <dl className="facts">
        {facts.map(([label, value]) => (
          <div key={label}>
            <dt>{label}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </>
  );
};

const PlotterMessage = ({ plotter: { connection, kind, message } }: { plotter: Plotter }) => {
  if (message && (connection === "fault" || connection === "absent")) {
    return (
      <p className="note note-error" role="alert">
        {message}
      </p>
    );
  }
  if (kind === "virtual") return <p className="note">{words.virtualHint}</p>;
  return message ? <p className="note">{message}</p> : null;
};

/** Which of the server's plotters the page shows and sends to; absent where there is one. */
const PlotterSelect = () => {
  const plotters = usePageState((state) => state.plotters);
  const current = usePageState(currentPlotter);
  const store = usePageStore();
  if (plotters.length < 2 || !current) return null;
  return (
    <Select
      label={words.which}
      value={current.id}
      options={plotters.map(({ id, name }) => ({ value: id, label: name }))}
      onChange={(plotterId) => store.setState({ plotterId })}
    />
  );
};

const ModelSelect = () => {
  const machine = usePageState((state) => state.settings.machine);
  const { changeSettings } = useActions();
  return (
    <Select
      label={words.model}
      value={machine}
      options={MACHINES.map(({ id, name }) => ({ value: id, label: name }))}
      onChange={(id) => changeSettings("machine", (settings) => ({ ...settings, machine: id }))}
    />
  );
};

const HandControls = ({ plotter }: { plotter: Plotter | null }) => {
  const pen = usePageState((state) => state.settings.pen);
  const { movePen, motorsOff, home } = useActions();
  const isOff = plotter?.connection !== "idle";
  return (
    <div className="button-grid">
      <button type="button" className="button" disabled={isOff} onClick={() => void movePen(true, pen.upPct)}>
        {words.penUp}
      </button>
      <button
        type="button"
        className="button"
        disabled={isOff}
        onClick={() => void movePen(false, pen.downPct)}
      >
        {words.penDown}
      </button>
      <button type="button" className="button" disabled={isOff} onClick={() => void motorsOff()}>
        {words.motorsOff}
      </button>
      <button type="button" className="button" disabled={isOff} onClick={() => void home()}>
        {words.home}
      </button>
    </div>
  );
};
