import { Component, lazy, Suspense, type ComponentType, type ReactNode } from "react";
import { errorText } from "./text.js";

/**
 * A part of the page that is fetched when it is first shown. One that can't be fetched (no connection, or the
 * server was brought up to date meanwhile) says so in its place; the rest of the page goes on.
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
        <button type="button" className="link" onClick={() => location.reload()}>
          {errorText.reload}
        </button>
      </p>
    );
  }
}
