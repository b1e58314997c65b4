import { useId } from "react";
import { useActions, usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { formatNumber } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { SettingsGroup } from "./settings-group.js";

const words = text.drawing;

export const DrawingPanel = () => {
  const drawing = usePageState((state) => state.drawing);
  const planned = usePageState((state) => state.planned);
  const size =
    planned && words.size(formatNumber(planned.pageWidthMm, 1), formatNumber(planned.pageHeightMm, 1));
  return (
    <SettingsGroup id="drawing" title={words.title}>
      {drawing && (
        <p className="drawing-name">
          <strong title={drawing.name}>{drawing.name}</strong>
          {size && <span className="note">{size}</span>}
        </p>
      )}
      <ChooseFile />
      <p className="note">{words.chooseHint}</p>
      <Samples />
      <Report />
    </SettingsGroup>
  );
};

const ChooseFile = () => {
  const id = useId();
  const { openFile } = useActions();
  return (
    <div className="choose">
      <input
        id={id}
        type="file"
        accept=".svg,image/svg+xml"
        className="visually-hidden"
        onChange={(event) => {
          const file = event.target.files?.[0];
          if (file) void openFile(file);
          event.target.value = "";
        }}
      />
      <label htmlFor={id} className="button">
        <Icon name="file" />
        {words.choose}
      </label>
    </div>
  );
};

const Samples = () => {
  const id = useId();
  const samples = usePageState((state) => state.samples);
  const { openSample } = useActions();
  if (samples.length === 0) return null;
  return (
    <div className="field">
      <label htmlFor={id}>{words.sample}</label>
      <select
        id={id}
        value=""
        onChange={(event) => {
          const sample = samples.find(({ name }) => name === event.target.value);
          if (sample) void openSample(sample.name, sample.title);
        }}
      >
        <option value="" disabled>
          {words.sampleHint}
        </option>
        {samples.map(({ name, title }) => (
          <option key={name} value={name}>
            {title}
          </option>
        ))}
      </select>
    </div>
  );
};

const Report = () => {
  const planned = usePageState((state) => state.planned);
  const notes = planned
    ? [...planned.fileWarnings.map(({ message }) => message), ...planned.layoutWarnings]
    : [];
  if (notes.length === 0) return null;
  return (
    <div className="report">
      <h3>
        <Icon name="warning" />
        {text.report.title}
      </h3>
      <ul>
        {notes.map((note) => (
          <li key={note}>{note}</li>
        ))}
      </ul>
    </div>
  );
};
