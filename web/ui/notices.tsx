import { useActions, usePageState } from "../state/use-store.js";
import { errorText } from "./text.js";
import { Icon } from "./icon.js";

/** Messages and errors. An error stays until it is closed or an action succeeds. */
export const Notices = () => {
  const notices = usePageState((state) => state.notices);
  const { dismiss } = useActions();
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
