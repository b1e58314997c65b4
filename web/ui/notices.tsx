import { useActions, usePageState } from "../state/use-store.js";
import { errorText } from "./text.js";
import { Icon } from "./icon.js";

/** What has just happened, and what went wrong, in words; errors stay until they are closed or something goes right. */
export const Notices = () => {
  const notices = usePageState((state) => state.notices);
  const { dismiss } = useActions();
  return (
    <div className="notices" aria-live="polite">
      {notices.map(({ id, kind, text: words }) => (
        <p key={id} className="notice" data-kind={kind} role={kind === "error" ? "alert" : undefined}>
          <span>{words}</span>
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
