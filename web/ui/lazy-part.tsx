import { lazy, Suspense, type ComponentType } from "react";
import { Button } from "./button.js";
import { ErrorBoundary } from "./error-boundary.js";
import { errorText } from "./text.js";

/**
 * A part of the page that is loaded when it is first shown. If it can't be loaded (no connection, or the server was
 * updated meanwhile), a message appears in its place. The rest of the page keeps working.
 */
export const lazyPart = <Props extends object>(
  load: () => Promise<ComponentType<Props>>,
): ComponentType<Props> => {
  const Part = lazy(async () => ({ default: await load() })) as unknown as ComponentType<Props>;
  const LazyPart = (props: Props) => (
    <ErrorBoundary fallback={() => <PartMissing />}>
      <Suspense fallback={null}>
        <Part {...props} />
      </Suspense>
    </ErrorBoundary>
  );
  return LazyPart;
};

const PartMissing = () => (
  <p className="note note-error" role="alert">
    {errorText.partMissing}{" "}
    <Button kind="link" onClick={() => location.reload()}>
      {errorText.reload}
    </Button>
  </p>
);
