/** Opens the plotter that a program asks for: one of its own, or one of a running server. */
import { PlotwrightError, type Transport } from "../../src/index.js";
import type { OpenSocket } from "./live-socket.js";
import { openOwnPlotter, type ClockAndPorts } from "./own-plotter.js";
import type { PlotterChoice, PlotterHandle } from "./plotter-handle.js";
import { openServedPlotter } from "./served-plotter.js";

export type { PlotterChoice, PlotterHandle } from "./plotter-handle.js";

const WAYS = ["device", "webSerial", "virtual", "url"] as const;
/** A faster board would count as silent while this program plans. */
const MAX_VIRTUAL_SPEED = 200;
const OTHERS = ["key", "plotter", "settings"];

/** `openSocket` opens a WebSocket. `openWebSerial` opens a port of `navigator.serial`; true: one that the user chooses. Null: this is no page. */
export async function openHandle(
  choice: PlotterChoice,
  parts: ClockAndPorts,
  openWebSerial: ((port: unknown) => Promise<Transport>) | null,
  openSocket: OpenSocket,
): Promise<PlotterHandle> {
  const way = wayOf(choice);
  const { device, webSerial, virtual, url, key, plotter, settings = {} } = choice;
  if (way === "url") {
    if (choice.settings !== undefined) {
      throw new PlotwrightError(
        "bad-setting",
        "openPlotter: a server has the settings of its plotters. Give those of a plot to plot.",
      );
    }
    const access = { url: addressOf(String(url)), ...(key === undefined ? {} : { key }) };
    return openServedPlotter(access, plotter, openSocket);
  }
  if (way === "virtual") {
    const virtualSpeed = typeof virtual === "object" ? virtual.speed : undefined;
    if (virtualSpeed !== undefined && !(virtualSpeed > 0 && virtualSpeed <= MAX_VIRTUAL_SPEED)) {
      throw new PlotwrightError(
        "bad-setting",
        `openPlotter: virtual.speed is ${virtualSpeed}: give more than 0, and at most ${MAX_VIRTUAL_SPEED}.`,
      );
    }
    return openOwnPlotter({ device: "virtual", virtualSpeed }, settings, parts);
  }
  if (way === "device") return openOwnPlotter({ device }, settings, parts);
  if (openWebSerial === null) {
    throw new PlotwrightError(
      "bad-setting",
      'openPlotter: webSerial is for pages. Give the path of the port in device, or "auto".',
    );
  }
  const devices = { find: () => Promise.resolve([]), open: () => openWebSerial(webSerial) };
  return openOwnPlotter({ device: "web-serial" }, settings, { ...parts, devices });
}

/** Throws `bad-setting` unless exactly one way is given, and nothing unknown. */
function wayOf(choice: PlotterChoice): (typeof WAYS)[number] {
  const names = [...WAYS, ...OTHERS];
  const unknown = Object.keys(choice).find((name) => !names.includes(name));
  if (unknown !== undefined) {
    throw new PlotwrightError(
      "bad-setting",
      `openPlotter: there is no option ${unknown}. There is ${names.join(", ")}.`,
    );
  }
  const given = WAYS.filter((way) => choice[way] !== undefined && choice[way] !== false);
  if (given.length === 1) return given[0];
  throw new PlotwrightError(
    "bad-setting",
    `openPlotter: give exactly one of ${WAYS.join(", ")}, for example { device: "auto" } or { virtual: true }.`,
  );
}

function addressOf(url: string): string {
  if (/^https?:\/\/[^/@]+@/.test(url)) {
    throw new PlotwrightError(
      "bad-setting",
      "url: leave out the user name and password. Give an access key in key.",
    );
  }
  if (/^https?:\/\//.test(url) && URL.canParse(url)) return url;
  throw new PlotwrightError("bad-setting", `url: ${url} is not an address such as http://127.0.0.1:9080.`);
}
