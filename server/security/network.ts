/** How other devices reach the server: its addresses, and QR codes with the pairing links. */
import { networkInterfaces } from "node:os";
import type { Pairing } from "../../src/schema/index.js";

/** The server's name on its network is plotwright.local, or plotwright-2.local if that is taken. */
export const LOCAL_NAME = "plotwright";

/** This computer's addresses on its networks, IPv4 first. */
export function lanAddresses(): string[] {
  const all = Object.values(networkInterfaces()).flatMap((list) => list ?? []);
  const outside = all.filter(({ internal, address }) => !internal && !address.startsWith("fe80:"));
  return outside
    .sort((a, b) => a.family.localeCompare(b.family))
    .map(({ address, family }) => (family === "IPv6" ? `[${address}]` : address));
}

/** Loaded when a code is drawn, because most servers never do. */
const loadQrcode = async (): Promise<typeof import("qrcode")> => (await import("qrcode")).default;

/** Paths of the links that pair a device, to append to an address of this computer. */
export interface PairingPaths {
  readonly operatePath: string;
  /** For a device that may only add drawings to the queue, and sees its own. */
  readonly submitPath: string;
  readonly watchPath: string;
}

/** The text that `serve --lan` prints: the pairing links and a QR code for the camera of a phone. */
export async function pairingText(
  baseUrl: string,
  { operatePath, submitPath, watchPath }: PairingPaths,
): Promise<string> {
  const qrcode = await loadQrcode();
  const code = await qrcode.toString(`${baseUrl}${operatePath}`, { type: "terminal", small: true });
  return `Pair a phone or another computer (keep these links to yourself):
  to operate  ${baseUrl}${operatePath}
  to watch    ${baseUrl}${watchPath}
  to submit   ${baseUrl}${submitPath}
${code}`;
}

/** The same links with their QR codes as images, for the page. */
export async function pairingLinks(baseUrl: string, isOnLan: boolean, paths: PairingPaths): Promise<Pairing> {
  const qrcode = await loadQrcode();
  const operateUrl = `${baseUrl}${paths.operatePath}`;
  const submitUrl = `${baseUrl}${paths.submitPath}`;
  const watchUrl = `${baseUrl}${paths.watchPath}`;
  const picture = (url: string): Promise<string> => qrcode.toString(url, { type: "svg", margin: 2 });
  return {
    isOnLan,
    operateUrl,
    submitUrl,
    watchUrl,
    operateQrSvg: await picture(operateUrl),
    submitQrSvg: await picture(submitUrl),
    watchQrSvg: await picture(watchUrl),
  };
}
