import type { Shortcut } from "./shortcuts.js";
import { usePageState } from "../state/use-store.js";
import { lazyPart } from "../ui/lazy-part.js";

const TakeOver = lazyPart(async () => (await import("./take-over.js")).TakeOver);
const HelpSheet = lazyPart(async () => (await import("./help.js")).HelpSheet);
const AboutDialog = lazyPart(async () => (await import("./about.js")).AboutDialog);
const Wizard = lazyPart(async () => (await import("../plotter/wizard.js")).Wizard);
const MachinesDialog = lazyPart(async () => (await import("../plotter/machines-dialog.js")).MachinesDialog);
const Console = lazyPart(async () => (await import("../plotter/console.js")).Console);
const RingingDialog = lazyPart(async () => (await import("../ringing/ringing.js")).RingingDialog);
const StudioDialog = lazyPart(async () => (await import("../studio/studio-dialog.js")).StudioDialog);

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
  const dialog = usePageState((state) => state.openDialog);
  switch (dialog) {
    case "keys":
      return <HelpSheet shortcuts={shortcuts} />;
    case "about":
      return <AboutDialog />;
    case "wizard":
      return <Wizard />;
    case "machines":
      return <MachinesDialog />;
    case "console":
      return <Console />;
    case "studio":
      return <StudioDialog />;
    case "ringing":
      return <RingingDialog />;
    case null:
      return null;
  }
};
