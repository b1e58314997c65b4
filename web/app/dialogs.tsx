import { PAGE_ACTIONS } from "./page-actions.js";
import { usePageState } from "../state/use-store.js";
import { lazyPart } from "../ui/lazy-part.js";

const TakeOver = lazyPart(async () => (await import("./take-over.js")).TakeOver);
const Search = lazyPart(async () => (await import("../search/search.js")).Search);
const DIALOGS = {
  keys: lazyPart(async () => (await import("./help.js")).HelpSheet),
  about: lazyPart(async () => (await import("./about.js")).AboutDialog),
  wizard: lazyPart(async () => (await import("../plotter/wizard.js")).Wizard),
  machines: lazyPart(async () => (await import("../plotter/machines-dialog.js")).MachinesDialog),
  console: lazyPart(async () => (await import("../plotter/console.js")).Console),
  ringing: lazyPart(async () => (await import("../ringing/ringing.js")).RingingDialog),
  studio: lazyPart(async () => (await import("../studio/studio-dialog.js")).StudioDialog),
} as const;

/** The open dialog, if any. The question is shown over it, so that what was typed into the dialog is kept. */
export const Dialogs = () => {
  const question = usePageState((state) => state.takeOverQuestion);
  return (
    <>
      <OpenDialog />
      {question && <TakeOver question={question} />}
    </>
  );
};

const OpenDialog = () => {
  const name = usePageState((state) => state.openDialog);
  if (name === null) return null;
  if (name === "search") return <Search actions={PAGE_ACTIONS} />;
  const Named = DIALOGS[name];
  return <Named />;
};
