/** The pen follows a slider: one move at a time, at most five a second, and of those that came meanwhile only the last. */

const REST_MS = 200;

interface Height {
  readonly isUp: boolean;
  readonly pct: number;
}

/** `move` never rejects. */
export const servoFollower = (
  move: (height: Height) => Promise<void>,
  after: (delayMs: number, callback: () => void) => void,
): ((height: Height) => void) => {
  let wanted: Height | null = null;
  let isFollowing = false;
  const follow = async (): Promise<void> => {
    while (wanted) {
      const next: Height = wanted;
      wanted = null;
      await Promise.all([move(next), new Promise<void>((resolve) => after(REST_MS, resolve))]);
    }
    isFollowing = false;
  };
  return (height) => {
    wanted = height;
    if (isFollowing) return;
    isFollowing = true;
    void follow();
  };
};
