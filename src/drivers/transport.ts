/** A connection to a board: a serial port, Web Serial or the virtual board. Provided by the host. */
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
  /** Closes the connection. Resolves when the port is free. */
  close(): Promise<void>;
}

/** Time, provided by the host: a real clock, or one that a test advances. */
export interface Clock {
  /** Seconds since an arbitrary start. Never runs backwards. */
  nowS(): number;
  /** Calls `callback` once after `delayS`. Returns a function that cancels it. */
  after(delayS: number, callback: () => void): () => void;
  /** How much later than usual timers may fire at present; default 0. This much more motion is sent ahead. */
  latenessS?(): number;
}

/** Resolves after `delayS` of the clock. */
export const delay = (clock: Clock, delayS: number): Promise<void> =>
  new Promise((resolve) => void clock.after(delayS, resolve));

/**
 * The clock of a virtual board that runs `speed` times faster than real time. The streamer uses it too, so the motion
 * sent ahead is the same in board time at any speed.
 */
export function scaledClock(clock: Clock, speed: number): Clock {
  if (speed === 1) return clock;
  return {
    nowS: () => clock.nowS() * speed,
    after: (delayS, callback) => clock.after(delayS / speed, callback),
  };
}
