import { useActions, usePageState } from "../state/use-store.js";
import { errorText } from "./text.js";
import { Icon } from "./icon.js";

interface NoticesProps {
  /** In an open dialog, which covers the page's own. */
  readonly isInDialog?: boolean;
}

/** Messages and errors, once at a time. An error stays until it is closed or an action succeeds. */
export const Notices = ({ isInDialog = false }: NoticesProps) => {
  const notices = usePageState((state) => state.notices);
  const isCovered = usePageState(({ openDialog }) => openDialog !== null && openDialog !== "search");
  const { dismiss } = useActions();
  if (isCovered !== isInDialog) return null;
  return (
    <div className="notices" aria-live="polite">
      {notices.map(({ id, kind, text }) => (
        <p key={id} className="notice" data-kind={kind} role={kind === "error" ? "alert" : undefined}>
          <span>{text}</span>
          <button
            type="button"
            className="notice-close"
            aria-label={errorText.close}
            onClick={() => dismiss(id)}
          >
            <Icon name="close" />
          </button>
        </p>
      ))}
    </div>
  );
};
