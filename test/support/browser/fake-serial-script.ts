/**
 * `navigator.serial` with one board, for a page and its workers: opens, reads and writes by requests to the test's
 * own process (fake-serial.ts). The board lives there, so it outlives the tab as a real one does.
 */
export const FAKE_SERIAL_SCRIPT = `(() => {
  const call = (name, init) => fetch(new URL("/fake-serial/" + name, self.location.origin), { method: "POST", ...init });
  // Like a system's driver: accepts 4 kB at once, and sends them in as few requests as possible.
  const buffered = () => {
    let waiting = [];
    let sending = null;
    let fault = null;
    const send = async () => {
      while (waiting.length > 0 && !fault) {
        const body = new Blob(waiting);
        waiting = [];
        if (!(await call("write", { body })).ok) fault = new DOMException("The device has been lost.", "NetworkError");
      }
      sending = null;
    };
    return new WritableStream({
      write: async (chunk) => {
        if (fault) throw fault;
        waiting.push(chunk.slice());
        sending ??= send();
        if (waiting.reduce((bytes, one) => bytes + one.length, 0) > 4096) await sending;
      },
    });
  };
  const port = Object.assign(new EventTarget(), {
    readable: null,
    writable: null,
    getInfo: () => ({ usbVendorId: 0x04d8, usbProductId: 0xfd92 }),
    open: async () => {
      const opened = await call("open");
      if (!opened.ok) throw new DOMException("Failed to open serial port.", "NetworkError");
      port.readable = (await call("read")).body;
      port.writable = buffered();
    },
    close: async () => {
      port.readable = port.writable = null;
      await call("close");
    },
  });
  const serial = Object.assign(new EventTarget(), {
    getPorts: async () => ((await (await call("permitted")).json()) ? [port] : []),
    requestPort: async () => {
      await call("permit");
      return port;
    },
  });
  Object.defineProperty(navigator, "serial", { value: serial, configurable: true });
})();
`;
