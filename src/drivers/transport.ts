/**
 * What the driver needs of a serial line, and of time. Given in by whoever runs it
 * (serialport, Web Serial, the virtual board; a real or a manual clock), because src has neither.
 */
export interface Transport {
  /** Queues bytes for the board. Resolves when the system has taken them; rejects with a PlotwrightError when the line is gone. */
  write(bytes: Uint8Array): Promise<void>;
  /** Called with every chunk that arrives. One listener at a time. */
  onData(listener: (bytes: Uint8Array) => void): void;
  /** Called once when the line is closed or lost; `error` undefined after a plain close(). */
  onClose(listener: (error?: Error) => void): void;
  close(): Promise<void>;
}

export interface Clock {
  /** Seconds; only differences mean anything; never runs backwards. */
  nowS(): number;
  /** Calls back once after `delayS`; returns a function that cancels it. */
  after(delayS: number, callback: () => void): () => void;
}

/** Asks a long computation to stop. An AbortSignal fits. */
export interface Cancellation {
  readonly aborted: boolean;
}
