/**
 * A virtual Grbl behind a real pseudo-terminal, in its own process. Started by pty-grbl.ts, which sends messages for what
 * happens to it.
 */
import { mkdtempSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { openPtyBoard } from "../../../server/cli/board/board.js";
import { nodeClock } from "../../../server/serial/node-clock.js";
import { VirtualGrbl } from "../../../src/drivers/grbl/virtual/virtual-grbl.js";
import type { FromGrbl, GrblOptions, ToGrbl } from "./pty-grbl.js";

const { machine, speed, ...options } = JSON.parse(process.argv[2]) as GrblOptions;
const board = new VirtualGrbl({ clock: nodeClock, speed, machine }, options);
const served = await openPtyBoard(board);
const folder = mkdtempSync(path.join(tmpdir(), "plotwright-pty-"));
const link = path.join(folder, "grbl");
const say = (message: FromGrbl): void => void process.send!(message);

function plugIn(): void {
  rmSync(link, { force: true });
  symlinkSync(served.path, link);
}

plugIn();
process.on("message", ({ type }: ToGrbl) => {
  switch (type) {
    case "unplug":
      rmSync(link, { force: true });
      board.unplug();
      break;
    case "replug":
      void served.replug().then(plugIn);
      break;
    case "report":
      say({
        type: "report",
        state: board.state(),
        drawn: board.drawn().map(({ penDown, xy }) => ({ penDown, xy: [...xy] })),
      });
      break;
  }
});
process.on("disconnect", () => {
  rmSync(folder, { recursive: true, force: true });
  void served.close().finally(() => process.exit(0));
});
say({ type: "open", path: link });
