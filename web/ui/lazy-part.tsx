import { Component, lazy, Suspense, type ComponentType, type ReactNode } from "react";
import { Button } from "./button.js";
import { errorText } from "./text.js";

/**
 * A part of the page that is loaded when it is first shown. If it can't be loaded (no connection, or the server was
 * updated meanwhile), a message appears in its place. The rest of the page keeps working.
 */
export const lazyPart = <Props extends object>(
  load: () => Promise<ComponentType<Props>>,
  fallback: ReactNode = null,
): ComponentType<Props> => {
  const Part = lazy(async () => ({ default: await load() })) as unknown as ComponentType<Props>;
  const LazyPart = (props: Props) => (
    <PartBoundary>
      <Suspense fallback={fallback}>
        <Part {...props} />
      </Suspense>
    </PartBoundary>
  );
  return LazyPart;
};

class PartBoundary extends Component<{ readonly children: ReactNode }, { readonly hasFailed: boolean }> {
  override state = { hasFailed: false };

  static getDerivedStateFromError(): { hasFailed: boolean } {
    return { hasFailed: true };
  }

  override render(): ReactNode {
    if (!this.state.hasFailed) return this.props.children;
    return (
      <p className="note note-error" role="alert">
        {errorText.partMissing}{" "}
        <Button kind="link" onClick={() => location.reload()}>
          {errorText.reload}
        </Button>
      </p>
    );
  }
}
