import { lazy, Suspense, type ComponentType, Component, type ReactNode } from "react";
import { Button } from "./button.js";
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

interface ErrorBoundaryProps {
  /** Shown instead of the children when rendering them fails. */
  fallback(message: string): ReactNode;
  readonly children: ReactNode;
}

interface State {
  readonly message: string | null;
}

export class ErrorBoundary extends Component<ErrorBoundaryProps, State> {
  override state: State = { message: null };

  static getDerivedStateFromError(error: unknown): State {
    return { message: error instanceof Error ? error.message : String(error) };
  }

  override render(): ReactNode {
    const { message } = this.state;
    return message === null ? this.props.children : this.props.fallback(message);
  }
}
