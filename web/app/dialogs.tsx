import type { Shortcut } from "./shortcuts.js";
import { usePageState } from "../state/use-store.js";
import { lazyPart } from "../ui/lazy-part.js";

const TakeOver = lazyPart(async () => (await import("./take-over.js")).TakeOver);
const HelpSheet = lazyPart(async () => (await import("./help.js")).HelpSheet);
const DIALOGS = {
  about: lazyPart(async () => (await import("./about.js")).AboutDialog),
  wizard: lazyPart(async () => (await import("../plotter/wizard.js")).Wizard),
  machines: lazyPart(async () => (await import("../plotter/machines-dialog.js")).MachinesDialog),
  console: lazyPart(async () => (await import("../plotter/console.js")).Console),
  ringing: lazyPart(async () => (await import("../ringing/ringing.js")).RingingDialog),
  studio: lazyPart(async () => (await import("../studio/studio-dialog.js")).StudioDialog),
} as const;

interface DialogsProps {
  readonly shortcuts: readonly Shortcut[];
}

/** The open dialog, if any. The question is shown over it, so that what was typed into the dialog is kept. */
export const Dialogs = ({ shortcuts }: DialogsProps) => {
  const question = usePageState((state) => state.takeOverQuestion);
  return (
    <>
      <OpenDialog shortcuts={shortcuts} />
      {question && <TakeOver question={question} />}
    </>
  );
};

const OpenDialog = ({ shortcuts }: DialogsProps) => {
  const name = usePageState((state) => state.openDialog);
  if (name === null) return null;
  if (name === "keys") return <HelpSheet shortcuts={shortcuts} />;
  const Named = DIALOGS[name];
  return <Named />;
};
