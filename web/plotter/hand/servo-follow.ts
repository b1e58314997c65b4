/**
 * Lets the pen follow a slider: one move at a time, at most five a second. Of the positions in between only the last
 * counts.
 */

const INTERVAL_MS = 200;

/** `move` never rejects. */
export const servoFollower = <Position extends object>(
  move: (position: Position) => Promise<unknown>,
  after = (delayMs: number, callback: () => void): void => void setTimeout(callback, delayMs),
): ((position: Position) => void) => {
  let wanted: Position | null = null;
  let isFollowing = false;
  const follow = async (): Promise<void> => {
    while (wanted) {
      const next: Position = wanted;
      wanted = null;
      await Promise.all([move(next), new Promise<void>((resolve) => after(INTERVAL_MS, resolve))]);
    }
    isFollowing = false;
  };
  return (position) => {
    wanted = position;
    if (isFollowing) return;
    isFollowing = true;
    void follow();
  };
};
