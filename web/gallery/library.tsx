import { useEffect, useRef, useState, type RefObject } from "react";
import { DRAWING_EXTENSIONS, isDrawingName } from "../../src/internal.js";
import type { LibraryFileInfo, LibraryList } from "../../src/schema/index.js";
import { contentOf, type DrawingText } from "../backend/drawing-text.js";
import { Thumb } from "../drawing/thumb.js";
import { useActions, useIsConnected, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { Sheet } from "../ui/dialog.js";
import { TextField } from "../ui/fields/text-field.js";
import { ChooseFile } from "../ui/files/choose-file.js";
import { formatBytes, formatWhen } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { RowMenu } from "../ui/rows/row-menu.js";
import { CloseWhenOpened, TYPING_MS } from "./gallery.js";
import { drawingText } from "../drawing/text.js";
import { libraryText as words } from "./text.js";
import "./gallery.css";

const ACCEPTED = DRAWING_EXTENSIONS.map((extension) => `.${extension}`).join();

const nameOf = (path: string): string => path.slice(path.lastIndexOf("/") + 1);
const joined = (...names: readonly string[]): string => names.filter(Boolean).join("/");

/** Drawings that the server keeps in folders: opened on the paper, added and removed here. */
export const Library = () => {
  const [folder, setFolder] = useState("");
  const [search, setSearch] = useState("");
  const { list, reload } = useList(folder, search.trim());
  const goTo = (path: string): void => {
    setFolder(path);
    setSearch("");
  };
  const path = useRef<HTMLElement>(null);
  useEffect(() => {
    // The tile that had the focus is gone.
    if (folder !== "") [...(path.current?.querySelectorAll("button") ?? [])].at(-1)?.focus();
  }, [folder]);
  return (
    <Sheet title={drawingText.library} className="dialog-wide">
      <CloseWhenOpened />
      <div className="library-bar">
        <FolderPath folder={folder} buttons={path} onGo={goTo} />
        <TextField label={words.search} isLabelInside value={search} maxLength={200} onChange={setSearch} />
      </div>
      <AddBar folder={folder} onAdded={reload} onMade={goTo} />
      {list === null ? (
        <div className="sheet-grid" aria-busy="true" />
      ) : (
        <Entries list={list} search={search.trim()} onGo={goTo} onRemoved={reload} />
      )}
    </Sheet>
  );
};

/** Lists a folder, or what a search finds there. Null: it has not arrived. */
const useList = (folder: string, search: string) => {
  const { listLibrary } = useActions();
  const isConnected = useIsConnected();
  const [reloads, setReloads] = useState(0);
  const [list, setList] = useState<(LibraryList & { readonly search: string }) | null>(null);
  useEffect(() => {
    let isCurrent = true;
    const timer = setTimeout(
      () =>
        void listLibrary({ folder, ...(search && { name: search }) }).then((answer) => {
          if (isCurrent && answer !== null) setList({ ...answer, search });
        }),
      search === "" ? 0 : TYPING_MS,
    );
    return () => {
      isCurrent = false;
      clearTimeout(timer);
    };
  }, [listLibrary, folder, search, reloads, isConnected]);
  const isCurrent = list?.folder === folder && list.search === search;
  return { list: isCurrent ? list : null, reload: () => setReloads(reloads + 1) };
};

interface PathProps {
  readonly folder: string;
  readonly buttons: RefObject<HTMLElement | null>;
  onGo(path: string): void;
}

/** "Library / plants / 2026": each name goes there. */
const FolderPath = ({ folder, buttons, onGo }: PathProps) => {
  const names = folder === "" ? [] : folder.split("/");
  return (
    <nav className="library-path" aria-label={words.path} ref={buttons}>
      <Button kind="link" onClick={() => onGo("")}>
        {drawingText.library}
      </Button>
      {names.map((name, depth) => (
        <span key={names.slice(0, depth + 1).join("/")}>
          {" / "}
          <Button kind="link" onClick={() => onGo(names.slice(0, depth + 1).join("/"))}>
            {name}
          </Button>
        </span>
      ))}
    </nav>
  );
};

interface AddBarProps {
  readonly folder: string;
  onAdded(): void;
  /** A new folder is made with its first drawing; until then it is only shown. */
  onMade(path: string): void;
}

const AddBar = ({ folder, onAdded, onMade }: AddBarProps) => {
  const { notify, saveToLibrary } = useActions();
  const drawing = usePageState((state) => state.drawing);
  const isOff = !useIsConnected();
  const [newName, setNewName] = useState("");
  const add = async (name: string, text: DrawingText): Promise<void> => {
    const saved = await saveToLibrary(joined(folder, isDrawingName(name) ? name : `${name}.svg`), text);
    if (saved === null) return;
    notify("info", words.saved(saved.path));
    onAdded();
  };
  return (
    <div className="library-bar">
      <ChooseFile
        label={words.upload}
        accept={ACCEPTED}
        icon="file"
        onFiles={([file]) => void file.arrayBuffer().then((bytes) => add(file.name, contentOf(bytes)))}
      />
      {drawing && (
        <Button disabled={isOff} onClick={() => void add(drawing.name, drawing.text)}>
          {words.save(drawing.name)}
        </Button>
      )}
      <form
        className="library-new"
        onSubmit={(event) => {
          event.preventDefault();
          if (newName.trim() === "") return;
          onMade(joined(folder, newName.trim()));
          setNewName("");
        }}
      >
        <TextField label={words.newFolder} isLabelInside value={newName} onChange={setNewName} />
        <Button type="submit" disabled={newName.trim() === ""}>
          {words.make}
        </Button>
      </form>
    </div>
  );
};

interface EntriesProps {
  readonly list: LibraryList;
  readonly search: string;
  onGo(path: string): void;
  onRemoved(): void;
}

const Entries = ({ list, search, onGo, onRemoved }: EntriesProps) => {
  if (list.folders.length + list.files.length === 0) {
    return <p className="note">{search === "" ? words.empty : words.nothingFound(search)}</p>;
  }
  return (
    <>
      {list.isCut && <p className="note">{words.isCut}</p>}
      <ul className="sheet-grid">
        {list.folders.map((path) => (
          <li key={path}>
            <FolderTile path={path} onGo={onGo} onRemoved={onRemoved} />
          </li>
        ))}
        {list.files.map((file) => (
          <li key={file.path}>
            <FileTile file={file} onRemoved={onRemoved} />
          </li>
        ))}
      </ul>
    </>
  );
};

interface FolderTileProps extends Pick<EntriesProps, "onGo" | "onRemoved"> {
  readonly path: string;
}

const FolderTile = ({ path, onGo, onRemoved }: FolderTileProps) => (
  <article className="sheet-tile">
    <button
      type="button"
      className="sheet-picture"
      aria-label={words.openFolder(nameOf(path))}
      onClick={() => onGo(path)}
    >
      <span className="library-folder">
        <Icon name="folder" />
      </span>
    </button>
    <RemovableName path={path} onRemoved={onRemoved} />
  </article>
);

const FileTile = ({ file, onRemoved }: { file: LibraryFileInfo; onRemoved(): void }) => {
  const { openFromLibrary } = useActions();
  const { path, bytes, changedAt } = file;
  return (
    <article className="sheet-tile">
      <button
        type="button"
        className="sheet-picture"
        aria-label={words.openNamed(nameOf(path))}
        onClick={() => void openFromLibrary(path)}
      >
        <Thumb of="library" id={path} changedAt={changedAt} />
      </button>
      <RemovableName path={path} onRemoved={onRemoved} />
      <p className="note">
        {formatBytes(bytes)} · {formatWhen(changedAt)}
      </p>
    </article>
  );
};

/** The name, and behind a menu its removal, which asks first. */
const RemovableName = ({ path, onRemoved }: { path: string; onRemoved(): void }) => {
  const { removeFromLibrary } = useActions();
  const isOff = !useIsConnected();
  const [isAsking, setAsking] = useState(false);
  const head = useRef<HTMLDivElement>(null);
  const name = nameOf(path);
  const keep = (): void => {
    setAsking(false);
    head.current?.querySelector("button")?.focus();
  };
  const remove = async (): Promise<void> => {
    setAsking(false);
    if ((await removeFromLibrary(path)) !== null) onRemoved();
  };
  return (
    <>
      <div className="sheet-head" ref={head}>
        <span className="job-name" title={path}>
          {name}
        </span>
        <RowMenu
          label={words.more(name)}
          items={[[words.remove, words.removeNamed(name), isOff, () => setAsking(true)]]}
        />
      </div>
      {isAsking && (
        <div className="ask" role="alertdialog" aria-label={words.remove}>
          <p>{words.confirm(name)}</p>
          <div className="button-row">
            <Button kind="danger" onClick={() => void remove()}>
              {words.remove}
            </Button>
            <Button autoFocus onClick={keep}>
              {words.keepIt}
            </Button>
          </div>
        </div>
      )}
    </>
  );
};
