/**
 * `navigator.serial` with one socket, for a page and its workers: opens, reads and writes by requests to the test's own
 * process (fake-serial.ts). What is plugged in lives there, so it outlives the tab as a real machine does.
 */
export const FAKE_SERIAL_SCRIPT = `(() => {
  const call = (name, init) => fetch(new URL("/fake-serial/" + name, self.location.origin), { method: "POST", ...init });
  // Like a system's driver: accepts 4 kB at once, and sends them in as few requests as possible.
  const buffered = (name) => {
    let waiting = [];
    let sending = null;
    let fault = null;
    const send = async () => {
      while (waiting.length > 0 && !fault) {
        const body = new Blob(waiting);
        waiting = [];
        if (!(await call(name, { body })).ok) fault = new DOMException("The device has been lost.", "NetworkError");
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
  const portOf = ({ id, ...info }) => {
    const port = Object.assign(new EventTarget(), {
      readable: null,
      writable: null,
      getInfo: () => info,
      open: async () => {
        const opened = await call("open/" + id);
        if (!opened.ok) throw new DOMException("Failed to open serial port.", "NetworkError");
        port.readable = (await call("read/" + id)).body;
        port.writable = buffered("write/" + id);
      },
      close: async () => {
        port.readable = port.writable = null;
        await call("close/" + id);
      },
    });
    return port;
  };
  // As in a browser, one port is one object until it is unplugged.
  const known = new Map();
  const portAt = (found) => {
    if (!known.has(found.id)) known.set(found.id, portOf(found));
    return known.get(found.id);
  };
  const serial = Object.assign(new EventTarget(), {
    getPorts: async () => (await (await call("ports")).json()).map(portAt),
    requestPort: async ({ filters = null } = {}) => {
      const chosen = await call("permit", { body: JSON.stringify(filters) });
      if (!chosen.ok) throw new DOMException("No port selected by the user.", "NotFoundError");
      return portAt(await chosen.json());
    },
  });
  Object.defineProperty(navigator, "serial", { value: serial, configurable: true });
})();
`;
