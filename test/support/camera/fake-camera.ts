/** Cameras on loopback: good ones, and whatever else may answer at an address. */
import { createServer, type IncomingMessage, type ServerResponse } from "node:http";
import type { AddressInfo } from "node:net";

const jpeg = (base64: string): Buffer => Buffer.from(base64, "base64");
/** 16 × 12 px, red and blue. */
export const RED = jpeg(
  "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDABALDA4MChAODQ4SERATGCgaGBYWGDEjJR0oOjM9PDkzODdASFxOQERXRTc4UG1RV19iZ2hnPk1xeXBkeFxlZ2P/2wBDARESEhgVGC8aGi9jQjhCY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2P/wAARCAAMABADASIAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAAAAX/xAAUEAEAAAAAAAAAAAAAAAAAAAAA/8QAFQEBAQAAAAAAAAAAAAAAAAAABAb/xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oADAMBAAIRAxEAPwCWAAon/9k=",
);
export const BLUE = jpeg(
  "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDABALDA4MChAODQ4SERATGCgaGBYWGDEjJR0oOjM9PDkzODdASFxOQERXRTc4UG1RV19iZ2hnPk1xeXBkeFxlZ2P/2wBDARESEhgVGC8aGi9jQjhCY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2P/wAARCAAMABADASIAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAAAAX/xAAUEAEAAAAAAAAAAAAAAAAAAAAA/8QAFAEBAAAAAAAAAAAAAAAAAAAABf/EABQRAQAAAAAAAAAAAAAAAAAAAAD/2gAMAwEAAhEDEQA/AIwB4e//2Q==",
);
export const PNG = jpeg(
  "iVBORw0KGgoAAAANSUhEUgAAABAAAAAMCAYAAABr5z2BAAAAKUlEQVR4AeyQMQ0AAAjDmilBAv4vnIGIPRxr0rdHNV3rKEwSgDz48OAAAAD//6tPUcsAAAAGSURBVAMAV6ghCcKQ/eoAAAAASUVORK5CYII=",
);

/** A picture that has a smaller one in its first segment, as most cameras make them. */
export const withThumbnail = (picture: Buffer, thumbnail: Buffer): Buffer => {
  const head = Buffer.from([0xff, 0xe1, (thumbnail.length + 2) >> 8, (thumbnail.length + 2) & 255]);
  return Buffer.concat([picture.subarray(0, 2), head, thumbnail, picture.subarray(2)]);
};

export interface FakeCamera {
  readonly url: string;
  /** The requests so far. */
  readonly requests: readonly { readonly path: string; readonly authorization: string | undefined }[];
  close(): Promise<void>;
}

type Answer = (response: ServerResponse, request: IncomingMessage, count: number) => void;

/** `answers`: by path. */
export async function fakeCamera(answers: Readonly<Record<string, Answer>>): Promise<FakeCamera> {
  const requests: { path: string; authorization: string | undefined }[] = [];
  const server = createServer((request, response) => {
    const path = new URL(request.url ?? "/", "http://camera").pathname;
    requests.push({ path, authorization: request.headers.authorization });
    response.on("error", () => undefined);
    const answer = answers[path];
    if (answer) answer(response, request, requests.length);
    else response.writeHead(404).end("nothing here");
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  return {
    url: `http://127.0.0.1:${(server.address() as AddressInfo).port}`,
    requests,
    close: () => {
      server.closeAllConnections();
      return new Promise((resolve) => server.close(() => resolve()));
    },
  };
}

export const still =
  (bytes: Buffer, type = "image/jpeg"): Answer =>
  (response) =>
    void response.writeHead(200, { "content-type": type }).end(bytes);

/** Sends the pictures as a stream that never ends. `boundary` as the header names it, which is not always what is sent. */
export const stream =
  (pictures: readonly Buffer[], boundary = "frame", hasLength = true): Answer =>
  (response) => {
    response.writeHead(200, { "content-type": `multipart/x-mixed-replace; boundary=${boundary}` });
    for (const picture of pictures) {
      const length = hasLength ? `Content-Length: ${picture.length}\r\n` : "";
      response.write(`--frame\r\nContent-Type: image/jpeg\r\n${length}\r\n`);
      response.write(picture);
      response.write("\r\n");
    }
  };

/** Sends these bytes for ever. */
export const endless =
  (type: string, first: Buffer, again: Buffer): Answer =>
  (response) => {
    response.writeHead(200, { "content-type": type });
    response.write(first);
    const more = (): void => {
      while (!response.destroyed) if (!response.write(again)) return void response.once("drain", more);
    };
    more();
  };
