import { Component, type ReactNode } from "react";
import { Button } from "./button.js";
import { errorText } from "./text.js";

interface State {
  readonly message: string | null;
}

/** Shows a message instead of an empty window when rendering the page fails. */
export class ErrorBoundary extends Component<{ readonly children: ReactNode }, State> {
  override state: State = { message: null };

  static getDerivedStateFromError(error: unknown): State {
    return { message: error instanceof Error ? error.message : String(error) };
  }

  override render(): ReactNode {
    if (this.state.message === null) return this.props.children;
    return (
      <main className="crash" role="alert">
        <h1>{errorText.title}</h1>
        <p>{errorText.unexpected}</p>
        <p className="note">{this.state.message}</p>
        <Button kind="primary" onClick={() => location.reload()}>
          {errorText.reload}
        </Button>
      </main>
    );
  }
}
