import { activeJob, onlySubmits, otherOperator, penWait, shownView } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { stripsText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { errorText } from "../ui/text.js";
import { lazyPart } from "../ui/lazy-part.js";

const PenWait = lazyPart(async () => (await import("../queue/pen-wait.js")).PenWait);

/** Messages over the paper, visible with any panel: about the server, another operator, a pen change. */
export const Strips = () => (
  <div>
    <LinkStrip />
    <PenStrip />
    <div role="status">
      <OperatorStrip />
    </div>
    <ServerNotices />
  </div>
);

/** The server can't be reached, or it has a newer page. */
const LinkStrip = () => {
  const link = usePageState((state) => state.link);
  const isOutdated = usePageState((state) => state.isOutdated);
  if (link === "lost") return <p className="strip strip-bad">{words.offline}</p>;
  if (!isOutdated) return null;
  return (
    <p className="strip">
      <span>{words.outdated}</span>
      <Button kind="small" onClick={() => location.reload()}>
        {errorText.reload}
      </Button>
    </p>
  );
};

const PenStrip = () => {
  const job = usePageState(activeJob);
  // In Watch the status card asks for the pen.
  const isWatched = usePageState((state) => shownView(state) === "watch");
  const wait = job && penWait(job);
  if (isWatched || !wait) return null;
  return (
    <div className="strip strip-wait">
      <PenWait job={job} wait={wait} />
    </div>
  );
};

const OperatorStrip = () => {
  const isWatching = usePageState((state) => state.me?.role === "watch");
  const isSubmitting = usePageState(onlySubmits);
  const other = usePageState(otherOperator);
  const { takeOver } = useActions();
  if (isWatching) return <p className="strip">{words.watching(other?.name ?? null)}</p>;
  if (isSubmitting) return <p className="strip">{words.submitting}</p>;
  if (!other) return null;
  return (
    <p className="strip">
      <span>{words.operating(other.name)}</span>
      <Button kind="small" onClick={() => void takeOver()}>
        {words.takeOver}
      </Button>
    </p>
  );
};

/**
 * Server errors that no request of this page caused, such as a bad file in the watched folder. Shown until dismissed.
 */
const ServerNotices = () => {
  const notices = usePageState((state) => state.serverNotices);
  const { dismissServerNotice } = useActions();
  return notices.slice(-3).map(({ id, message }) => (
    <p key={id} className="strip strip-bad" role="alert">
      <span>{message}</span>
      <Button kind="small" onClick={() => void dismissServerNotice(id)}>
        {words.read}
      </Button>
    </p>
  ));
};
