/**
 * What the driver needs from a serial port and a clock. Injected by the host (serialport, Web Serial or the
 * virtual board; a real or a manual clock), because src has no access to either.
 */
export interface Transport {
  /**
   * Queues bytes for the board. Resolves when the system has accepted them. Rejects with a PlotwrightError if
   * the connection is gone.
   */
  write(bytes: Uint8Array): Promise<void>;
  /** Called with every chunk that arrives. One listener at a time. */
  onData(listener: (bytes: Uint8Array) => void): void;
  /** Called once when the connection is closed or lost; `error` is undefined after a plain close(). */
  onClose(listener: (error?: Error) => void): void;
  close(): Promise<void>;
}

export interface Clock {
  /** Seconds since an arbitrary start. Never runs backwards. */
  nowS(): number;
  /** Calls `callback` once after `delayS`. Returns a function that cancels it. */
  after(delayS: number, callback: () => void): () => void;
}

/** Asks a long computation to stop. An AbortSignal fits. */
export interface Cancellation {
  readonly aborted: boolean;
}
