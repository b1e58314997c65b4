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

/** The text that `serve --lan` prints: the pairing links and a QR code for the camera of a phone. */
export async function pairingText(baseUrl: string, operatePath: string, watchPath: string): Promise<string> {
  const qrcode = await loadQrcode();
  const code = await qrcode.toString(`${baseUrl}${operatePath}`, { type: "terminal", small: true });
  return `Pair a phone or another computer (keep these links to yourself):
  to operate  ${baseUrl}${operatePath}
  to watch    ${baseUrl}${watchPath}
${code}`;
}

/** The same links with their QR codes as images, for the page. */
export async function pairingLinks(
  baseUrl: string,
  isOnLan: boolean,
  paths: { readonly operatePath: string; readonly watchPath: string },
): Promise<Pairing> {
  const qrcode = await loadQrcode();
  const [operateUrl, watchUrl] = [`${baseUrl}${paths.operatePath}`, `${baseUrl}${paths.watchPath}`];
  const picture = (url: string): Promise<string> => qrcode.toString(url, { type: "svg", margin: 2 });
  return {
    isOnLan,
    operateUrl,
    watchUrl,
    operateQrSvg: await picture(operateUrl),
    watchQrSvg: await picture(watchUrl),
  };
}
