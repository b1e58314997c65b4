import type { ReactNode } from "react";
import { usePageStore } from "../state/use-store.js";
import { Dialog } from "./dialog.js";
import { Notices } from "./notices.js";

/** A dialog of the page. What goes wrong meanwhile is said in it, since it lies over everything else. */
export const Sheet = ({ title, children }: { title: string; children: ReactNode }) => {
  const store = usePageStore();
  return (
    <Dialog title={title} onClose={() => store.setState({ openDialog: null })}>
      <Notices />
      {children}
    </Dialog>
  );
};
