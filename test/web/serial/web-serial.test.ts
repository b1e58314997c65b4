/** The Web Serial transport over real streams, with the virtual board behind the port. */
import { describe, expect, it } from "vitest";
import { BoardSession, PlotwrightError, VirtualBoard } from "../../../src/index.js";
import {
  browserClock,
  openWebSerial,
  requestBoard,
  type WebSerial,
  type WebSerialPort,
} from "../../../web/serial/web-serial.js";

interface Port extends WebSerialPort {
  isOpen: boolean;
  /** Like an unplugged cable: reading and writing fail. */
  unplug(): void;
}

/** The browser's side of a USB cable with a virtual board at its other end. */
function portOfVirtualBoard(): Port {
  const board = new VirtualBoard({ clock: browserClock(), speed: Infinity });
  const gone = new Error("The device has been lost.");
  let toPage: ReadableStreamDefaultController<Uint8Array> | undefined;
  let toBoard: WritableStreamDefaultController | undefined;
  const port: Port = {
    isOpen: false,
    readable: new ReadableStream<Uint8Array>({
      start: (controller) => {
        toPage = controller;
        board.onSend((bytes) => controller.enqueue(bytes.slice()));
      },
    }),
    writable: new WritableStream<Uint8Array>({
      start: (controller) => {
        toBoard = controller;
      },
      write: (bytes) => board.receive(bytes),
    }),
    open: () => {
      port.isOpen = true;
      return Promise.resolve();
    },
    close: () => {
      port.isOpen = false;
      return Promise.resolve();
    },
    unplug: () => {
      toPage?.error(gone);
      toBoard?.error(gone);
    },
  };
  return port;
}

const codeOf = async (work: Promise<unknown>): Promise<string> =>
  work.then(
    () => "nothing",
    (error: unknown) => (error instanceof PlotwrightError ? error.code : String(error)),
  );

describe("a board on Web Serial", () => {
  it("identifies itself, and releases the port when the session is closed", async () => {
    const port = portOfVirtualBoard();
    const session = new BoardSession(await openWebSerial(port), { clock: browserClock() });
    expect((await session.identify()).firmware).toBe("2.8.1");
    await session.close();
    expect(port.isOpen).toBe(false);
    expect(port.readable?.locked).toBe(false);
    expect(port.writable?.locked).toBe(false);
  });

  it("notifies the session when the cable is unplugged, and refuses to write then", async () => {
    const port = portOfVirtualBoard();
    const transport = await openWebSerial(port);
    const closed = new Promise<Error | undefined>((resolve) => transport.onClose(resolve));
    port.unplug();
    expect(await closed).toMatchObject({ code: "disconnected" });
    expect(await codeOf(transport.write(new Uint8Array([86, 13])))).toBe("disconnected");
  });

  it("reports a plain close without an error", async () => {
    const transport = await openWebSerial(portOfVirtualBoard());
    const closed = new Promise<Error | undefined>((resolve) => transport.onClose(resolve));
    await transport.close();
    expect(await closed).toBeUndefined();
  });

  it("asks for an EiBotBoard by its USB ids, and for the USB chips of Grbl boards", async () => {
    let asked: unknown;
    const serial: WebSerial = {
      requestPort: (options) => {
        asked = options;
        return Promise.resolve(portOfVirtualBoard());
      },
    };
    await (await requestBoard(serial)).close();
    expect(asked).toEqual({
      filters: [
        { usbVendorId: 0x04d8, usbProductId: 0xfd92 },
        { usbVendorId: 0x1a86 },
        { usbVendorId: 0x0403, usbProductId: 0x6001 },
        { usbVendorId: 0x0403, usbProductId: 0x6015 },
        { usbVendorId: 0x10c4, usbProductId: 0xea60 },
        { usbVendorId: 0x2341 },
        { usbVendorId: 0x2a03 },
        { usbVendorId: 0x303a },
      ],
    });
  });

  it("explains what to do if nothing was chosen, the port is taken, or the browser has no support", async () => {
    const nothingChosen = new Error("No port selected by the user.");
    expect(await codeOf(requestBoard({ requestPort: () => Promise.reject(nothingChosen) }))).toBe("no-board");
    const taken = { ...portOfVirtualBoard(), open: () => Promise.reject(new Error("Failed to open")) };
    expect(await codeOf(openWebSerial(taken))).toBe("busy");
    expect(await codeOf(requestBoard())).toBe("not-allowed");
  });
});
