/** How other devices find the server: its addresses, a QR code with the pairing link, and an mDNS name. */
import { networkInterfaces } from "node:os";
import { Bonjour } from "bonjour-service";
import qrcode from "qrcode";
import type { Pairing } from "../../src/schema/index.js";

export const MDNS_NAME = "plotwright";

/** This computer's addresses on its networks, IPv4 first. */
export function lanAddresses(): string[] {
  const all = Object.values(networkInterfaces()).flatMap((list) => list ?? []);
  const outside = all.filter(({ internal, address }) => !internal && !address.startsWith("fe80:"));
  return outside
    .sort((a, b) => a.family.localeCompare(b.family))
    .map(({ address, family }) => (family === "IPv6" ? `[${address}]` : address));
}

/** What `serve --lan` prints: where to go on a phone, and a code to point its camera at. */
export async function pairingText(baseUrl: string, operatePath: string, watchPath: string): Promise<string> {
  const code = await qrcode.toString(`${baseUrl}${operatePath}`, { type: "terminal", small: true });
  return `Pair a phone or another computer (keep these links to yourself):
  to operate  ${baseUrl}${operatePath}
  to watch    ${baseUrl}${watchPath}
${code}`;
}

/** The same links with their codes as pictures, for the page. */
export async function pairingLinks(
  baseUrl: string,
  isOnLan: boolean,
  paths: { readonly operatePath: string; readonly watchPath: string },
): Promise<Pairing> {
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

/** Announces http://plotwright.local; returns what takes it back. */
export function announceOnLan(port: number, isTls: boolean): () => Promise<void> {
  const bonjour = new Bonjour({}, () => undefined);
  const service = bonjour.publish({
    name: "plotwright",
    type: isTls ? "https" : "http",
    port,
    host: `${MDNS_NAME}.local`,
  });
  // No network, or a name that is taken: the addresses work without it.
  service.on("error", () => undefined);
  return () =>
    new Promise((resolve) => {
      bonjour.unpublishAll(() => {
        bonjour.destroy();
        resolve();
      });
    });
}
