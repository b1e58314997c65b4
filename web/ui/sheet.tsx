import type { ReactNode } from "react";
import { usePageStore } from "../state/use-store.js";
import { Dialog } from "./dialog.js";
import { Notices } from "./notices.js";

/** One of the page's dialogs. It shows the notices itself, because it covers the page's. */
export const Sheet = ({ title, children }: { title: string; children: ReactNode }) => {
  const store = usePageStore();
  return (
    <Dialog title={title} onClose={() => store.setState({ openDialog: null })}>
      <Notices />
      {children}
    </Dialog>
  );
};
