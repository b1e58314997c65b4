/** A virtual board that takes and sends text instead of bytes. */
import { VirtualBoard, type VirtualBoardOptions } from "../../../src/drivers/ebb/virtual/virtual-board.js";
import { ManualClock } from "../clocks/manual-clock.js";

export const ascii = (text: string): Uint8Array => Uint8Array.from(text, (c) => c.charCodeAt(0));

/** `ask` sends a line, and returns what the board answers at once. */
export function boardWith(options: Partial<VirtualBoardOptions> = {}) {
  const clock = new ManualClock();
  const board = new VirtualBoard({ clock, ...options });
  let sent = "";
  board.onSend((bytes) => (sent += String.fromCharCode(...bytes)));
  const take = (): string => {
    const text = sent;
    sent = "";
    return text;
  };
  const ask = (line: string): string => {
    board.receive(ascii(`${line}\r`));
    return take();
  };
  return { clock, board, take, ask };
}
