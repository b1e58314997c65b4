/** The faults that tests cause on the virtual board, and what it keeps over a reset. */
import { describe, expect, it } from "vitest";
import { ascii, boardWith } from "../../../../support/machines/board-in-text.js";

describe("the virtual board's faults", () => {
  it("loses as many replies as requested", () => {
    const { ask, board } = boardWith();
    board.loseReplies(1);
    expect(ask("QP")).toBe("");
    expect(ask("QP")).toBe("1\n\rOK\r\n");
  });

  it("executes commands in silence while it is mute", () => {
    const { ask, board } = boardWith({ speed: Infinity });
    board.setMute(true);
    expect(ask("SM,10,5,5")).toBe("");
    board.setMute(false);
    expect(ask("QS")).toBe("5,5\n\rOK\r\n");
  });

  it("answers while its motion is frozen, and continues where it stopped", async () => {
    const { ask, board, clock } = boardWith();
    ask("SM,1000,100,100");
    await clock.advance(0.501);
    board.setFrozen(true);
    await clock.advance(10);
    expect(ask("QS")).toBe("50,50\n\rOK\r\n");
    expect(ask("QM")).toBe("QM,1,1,1,0\n\r");
    expect(ask("SM,1000,-100,-100")).toBe("OK\r\n");
    expect(ask("SM,10,0,0")).toBe("");
    board.setFrozen(false);
    await clock.advance(0.2501);
    expect(board.state()).toMatchObject({ steps1: 75, steps2: 75 });
    await clock.advance(1.3);
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, isBusy: false });
  });

  it("begins orders received while frozen when it is unfrozen, and drops them at ES", async () => {
    const { ask, board, clock } = boardWith();
    board.setFrozen(true);
    ask("SM,1000,100,100");
    await clock.advance(3);
    expect(board.state()).toMatchObject({ steps1: 0, isBusy: true });
    board.setFrozen(false);
    await clock.advance(0.5001);
    expect(board.state()).toMatchObject({ steps1: 50, isBusy: true });
    board.setFrozen(true);
    await clock.advance(3);
    expect(ask("ES")).toContain("OK");
    expect(board.state()).toMatchObject({ steps1: 50, isBusy: false });
  });

  it("spends the time of moves without a step while it is motionless", async () => {
    const { ask, board, clock } = boardWith();
    ask("SM,1000,100,100");
    await clock.advance(0.5001);
    board.setMotionless(true);
    await clock.advance(0.6);
    expect(board.state()).toMatchObject({ steps1: 50, steps2: 50, isBusy: false });
    ask("SM,100,10,10");
    await clock.advance(0.2);
    expect(ask("QS")).toBe("50,50\n\rOK\r\n");
    board.setMotionless(false);
    ask("SM,100,10,10");
    await clock.advance(0.2);
    expect(ask("QS")).toBe("60,60\n\rOK\r\n");
  });

  it.each(["R", "RB"])("keeps its name over %s, but no other settings", (reset) => {
    const { ask } = boardWith({ firmware: "3.0.3" });
    for (const line of ["ST,easel", "SL,7,3", "SN,9", "CU,60,300", "EM,1,1"]) ask(line);
    ask(reset);
    expect(ask("QL,3")).toBe("0\r\nOK\r\n");
    expect(ask("QN")).toBe("0\r\nOK\r\n");
    expect(ask("QE")).toBe("0,0\n\rOK\r\n");
    expect(ask("QT")).toBe("easel\r\nOK\r\n");
  });

  it("reports its supply", () => {
    const { ask, board } = boardWith({ firmware: "3.0.3" });
    board.setMotorVolts(5);
    const reading = Number(/^394,(\d+)/.exec(ask("QC"))![1]);
    expect(reading).toBeGreaterThan(140);
    expect(reading).toBeLessThan(250);
    ask("R");
    expect(ask("QC")).toContain(`394,${reading}`);
  });

  it("loses its counters and the connection at a power failure", async () => {
    const { ask, board } = boardWith({ speed: Infinity });
    const transport = board.transport();
    const closed = new Promise<Error | undefined>((resolve) => transport.onClose(resolve));
    ask("SM,10,5,5");
    board.resetByPower();
    expect(await closed).toMatchObject({ code: "disconnected" });
    await expect(transport.write(ascii("QS\r"))).rejects.toMatchObject({ code: "disconnected" });
    expect(ask("QS")).toBe("0,0\n\rOK\r\n");
  });

  it("keeps its position if only the cable is unplugged", () => {
    const { ask, board } = boardWith({ speed: Infinity });
    ask("SM,10,5,5");
    board.unplug();
    expect(ask("QS")).toBe("5,5\n\rOK\r\n");
  });

  it("counts the gap as an underrun only when a slow connection starves a moving pen", async () => {
    const fast = boardWith();
    fast.board.receive(ascii("SM,20,80,80\r".repeat(30)));
    await fast.clock.advance(2);
    expect(fast.board.statistics()).toMatchObject({ underrunCount: 0, moveCount: 30 });

    const slow = boardWith();
    slow.board.setUsbBytesPerS(300);
    slow.board.receive(ascii("SM,20,80,80\r".repeat(30)));
    await slow.clock.advance(2);
    const { underrunCount, underrunS } = slow.board.statistics();
    expect(underrunCount).toBe(29);
    expect(underrunS).toBeCloseTo(29 * 0.02, 2);
  });
});
