import { DRAWING_EXTENSIONS, PX_NOTE } from "../../src/internal.js";
import { mayOperate } from "../state/store.js";
import { useActions, useBackend, usePageState, usePageStore } from "../state/use-store.js";
import type { Planned } from "../worker/protocol.js";
import { useFilesPage } from "./drawn-size.js";
import { FillChoice } from "./fill-choice.js";
import { paperLabel } from "./paper.js";
import { drawingText as words, reportText, saveText } from "./text.js";
import { Button } from "../ui/button.js";
import { ChooseFile } from "../ui/files/choose-file.js";
import { formatSize } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { useShownAgain } from "../ui/fields/choice.js";
import { SettingsGroup } from "../ui/fields/settings-group.js";
import { Panel } from "../ui/panel.js";
import { lazyPart } from "../ui/lazy-part.js";

const SheetPart = lazyPart(async () => (await import("./sheet/sheet-part.js")).SheetPart);

export const DrawingPanel = () => {
  const drawing = usePageState((state) => state.drawing);
  const planned = usePageState((state) => state.planned);
  const unit = usePageState((state) => state.view.lengthUnit);
  const hasSheet = Boolean(drawing?.sheet);
  const size =
    planned && !hasSheet && words.size(formatSize(planned.pageWidthMm, planned.pageHeightMm, unit));
  return (
    <Panel id="drawing" title={words.title} help={words.chooseHint}>
      {drawing && (
        <p className="drawing-name">
          <strong title={drawing.name}>{drawing.name}</strong>
          {size && <span className="note">{size}</span>}
        </p>
      )}
      <div className="choose-row">
        <ChooseDrawing label={words.choose} />
        <Samples />
        {drawing && <AddDrawings />}
        <OpenLibrary />
      </div>
      {drawing && <SheetPart />}
      <FillChoice />
      <Report />
      <ExportPanel />
    </Panel>
  );
};

const ACCEPTED = ["image/svg+xml", ...DRAWING_EXTENSIONS.map((extension) => `.${extension}`)].join();

export const ChooseDrawing = ({ label }: { label: string }) => {
  const { openFile } = useActions();
  return <ChooseFile label={label} accept={ACCEPTED} icon="file" onFiles={([file]) => void openFile(file)} />;
};

const AddDrawings = () => {
  const { addFiles } = useActions();
  return (
    <ChooseFile
      label={words.add}
      accept={ACCEPTED}
      icon="plus"
      isMultiple
      onFiles={(files) => void addFiles(files)}
    />
  );
};

const OpenLibrary = () => {
  const { features } = useBackend();
  const { openDialog } = useActions();
  const isOperator = usePageState(mayOperate);
  if (!features.library || !isOperator) return null;
  return (
    <Button onClick={() => openDialog("library")}>
      <Icon name="folder" />
      {words.library}
    </Button>
  );
};

const Samples = () => {
  const samples = usePageState((state) => state.samples);
  const { openSample } = useActions();
  const open = useShownAgain((chosen: string) => {
    const sample = samples.find(({ name }) => name === chosen);
    if (sample) void openSample(sample.name, sample.title);
  });
  if (samples.length === 0) return null;
  return (
    <select aria-label={words.sampleHint} value="" onChange={(event) => open(event.target.value)}>
      <option value="" disabled>
        {words.sample}
      </option>
      {samples.map(({ name, title }) => (
        <option key={name} value={name}>
          {title}
        </option>
      ))}
    </select>
  );
};

/** The warnings: what will not be drawn. A warning with places has a button that shows them on the paper. */
const Report = () => {
  const planned = usePageState((state) => state.planned);
  const noteBoxes = usePageState((state) => state.noteBoxes);
  const store = usePageStore();
  if (!planned || planned.fileWarnings.length + planned.layoutWarnings.length === 0) return null;
  return (
    <div className="report">
      <h3>
        <Icon name="warning" />
        {reportText.title}
      </h3>
      <ul>
        {planned.fileWarnings.map(({ code, message, boxes }) => (
          <li key={code + message}>
            {message}
            {boxes.length > 0 && (
              <Button
                kind="link"
                aria-pressed={noteBoxes === boxes}
                onClick={() => store.setState({ noteBoxes: noteBoxes === boxes ? [] : boxes })}
              >
                {reportText.show}
              </Button>
            )}
            {code === PX_NOTE && <OtherPapers planned={planned} />}
          </li>
        ))}
        {planned.layoutWarnings.map((note) => (
          <li key={note}>{note}</li>
        ))}
      </ul>
    </div>
  );
};

/** Buttons that read the file with the px per inch that make its page a paper. */
const OtherPapers = ({ planned }: { planned: Planned }) => {
  const takePage = useFilesPage();
  return planned.otherPapers.map(({ name, pxPerInch }) => {
    const factor = (planned.pxPerInch ?? pxPerInch) / pxPerInch;
    const page = { widthMm: planned.pageWidthMm * factor, heightMm: planned.pageHeightMm * factor };
    return (
      <Button key={name + pxPerInch} kind="link" onClick={() => takePage(page, { pxPerInch })}>
        {reportText.paper(paperLabel(name), pxPerInch)}
      </Button>
    );
  });
};

const ExportList = lazyPart(async () => (await import("./export-list.js")).ExportList);

/** Saves what will be plotted as files. */
const ExportPanel = () => {
  const canExport = usePageState((state) => (state.planned?.strokeCount ?? 0) > 0);
  if (!canExport) return null;
  return (
    <SettingsGroup id="export" title={saveText.title} isPart isLazy>
      <ExportList />
    </SettingsGroup>
  );
};
