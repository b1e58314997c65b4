/** The test's end of fake-serial-script.ts: one socket for a virtual machine on USB, by HTTP. */
import type { IncomingMessage, ServerResponse } from "node:http";
import { json } from "node:stream/consumers";
import { VirtualBoard, type Transport } from "../../../src/index.js";
import { hasUsbId } from "../../../src/internal.js";
import { nodeClock } from "../../../server/serial/node-clock.js";

/** What can be plugged in. */
export interface UsbDevice {
  readonly machine: Pick<VirtualBoard, "transport" | "unplug" | "close">;
  /** Hexadecimal, lower case. */
  readonly vendorId: string;
  readonly productId: string;
  /** Without one, the browser forgets with each unplugging that the page may use it. */
  readonly hasSerialNumber: boolean;
}

interface PortFilter {
  readonly usbVendorId: number;
  readonly usbProductId?: number;
}

const hex = (id: number): string => id.toString(16).padStart(4, "0");

export class FakeSerial {
  /** On an EiBotBoard, which is plugged in at first. */
  readonly board: VirtualBoard;
  /** All that pages have written. */
  heard = "";
  private plugged: UsbDevice | null;
  /** Of the port: plugged in again, a device is another port. */
  private portId = 1;
  private readonly permitted = new Set<UsbDevice>();
  private readonly used = new Set<UsbDevice>();
  private transport: Transport | null = null;
  private reader: ServerResponse | null = null;

  /** `speed`: board seconds per second. */
  constructor(speed = 1) {
    this.board = new VirtualBoard({ clock: nodeClock, speed, servo: {} });
    this.plugged = { machine: this.board, vendorId: "04d8", productId: "fd92", hasSerialNumber: true };
    this.used.add(this.plugged);
  }

  /** Whether a page has the port open. */
  get isOpen(): boolean {
    return this.reader !== null;
  }

  /** In place of what is plugged in. */
  plug(device: UsbDevice): void {
    this.unplug();
    this.plugged = device;
    this.used.add(device);
    this.portId++;
  }

  unplug(): void {
    const device = this.plugged;
    this.plugged = null;
    if (device?.hasSerialNumber === false) this.permitted.delete(device);
    device?.machine.unplug();
    this.transport = null;
    // An open port fails in the page.
    this.reader?.destroy();
    this.reader = null;
  }

  async handle(name: string, request: IncomingMessage, response: ServerResponse): Promise<void> {
    const [action, portId] = name.split("/");
    if (action !== "ports" && action !== "permit" && Number(portId) !== this.portId)
      return answer(response, 410);
    switch (action) {
      case "permit":
        return this.permit((await json(request)) as PortFilter[] | null, response);
      case "ports":
        return answer(response, 200, this.ports());
      case "open":
        return answer(response, this.open() ? 200 : 409);
      case "read":
        return this.read(response);
      case "write":
        return this.write(request, response);
      case "close":
        await this.transport?.close();
        this.transport = null;
        return answer(response, 200);
      default:
        answer(response, 404);
    }
  }

  close(): void {
    this.reader?.end();
    for (const { machine } of this.used) machine.close();
  }

  /** Those that the page may use. */
  private ports(): object[] {
    const device = this.plugged;
    if (device === null || !this.permitted.has(device)) return [];
    const ids = { usbVendorId: parseInt(device.vendorId, 16), usbProductId: parseInt(device.productId, 16) };
    return [{ id: this.portId, ...ids }];
  }

  /** The user chooses what is plugged in, if the browser lists it. */
  private permit(filters: PortFilter[] | null, response: ServerResponse): void {
    const ids = filters?.map(({ usbVendorId, usbProductId }) => ({
      vendorId: hex(usbVendorId),
      ...(usbProductId === undefined ? {} : { productId: hex(usbProductId) }),
    }));
    const device = this.plugged;
    if (device === null || (ids && !hasUsbId(ids, device.vendorId, device.productId)))
      return answer(response, 404);
    this.permitted.add(device);
    answer(response, 200, this.ports()[0]);
  }

  private open(): boolean {
    if (this.reader !== null || this.plugged === null) return false;
    this.transport = this.plugged.machine.transport();
    return true;
  }

  /** Frees the port after the tab has died. The board keeps its commands, because nothing has closed the link. */
  private read(response: ServerResponse): void {
    response.writeHead(200, { "content-type": "application/octet-stream", "cache-control": "no-store" });
    response.flushHeaders();
    this.reader = response;
    this.transport?.onData((bytes) => response.write(bytes));
    response.on("close", () => {
      if (this.reader === response) this.reader = null;
    });
  }

  private async write(request: IncomingMessage, response: ServerResponse): Promise<void> {
    const chunks: Buffer[] = [];
    for await (const chunk of request) chunks.push(chunk as Buffer);
    const bytes = Buffer.concat(chunks);
    this.heard += bytes.toString("latin1");
    try {
      await this.transport?.write(new Uint8Array(bytes));
      answer(response, this.transport === null ? 410 : 200);
    } catch {
      answer(response, 410);
    }
  }
}

function answer(response: ServerResponse, status: number, content: unknown = null): void {
  response
    .writeHead(status, { "content-type": "application/json", "cache-control": "no-store" })
    .end(JSON.stringify(content));
}
