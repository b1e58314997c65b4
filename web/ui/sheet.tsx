import type { ReactNode } from "react";
import { useActions } from "../state/use-store.js";
import { Dialog } from "./dialog.js";
import { Notices } from "./notices.js";

/** One of the page's dialogs. It shows the notices itself, because it covers the page's. */
export const Sheet = ({ title, children }: { title: string; children: ReactNode }) => {
  const { closeDialog } = useActions();
  return (
    <Dialog title={title} onClose={closeDialog}>
      <Notices />
      {children}
    </Dialog>
  );
};
