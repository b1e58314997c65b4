/** The globals of both Node and browsers that host uses. Only the type check of host reads this file. */
interface AbortSignal {
  readonly aborted: boolean;
  addEventListener(type: "abort", listener: () => void, options?: { once?: boolean }): void;
  removeEventListener(type: "abort", listener: () => void): void;
}
declare class AbortController {
  readonly signal: AbortSignal;
  abort(): void;
}
declare const crypto: { randomUUID(): string };
declare function setTimeout(callback: () => void, delayMs: number): number;
declare function clearTimeout(timer: number): void;
declare function setInterval(callback: () => void, periodMs: number): number;
declare function clearInterval(timer: number): void;
declare function queueMicrotask(callback: () => void): void;
declare class URL {
  constructor(path: string, base?: string);
  static canParse(text: string): boolean;
  readonly hostname: string;
  readonly href: string;
}
declare class TextDecoder {
  decode(bytes: Uint8Array | undefined, options: { stream: boolean }): string;
}
interface FetchResponse {
  readonly ok: boolean;
  readonly status: number;
  readonly body: {
    getReader(): {
      read(): Promise<{ readonly done: boolean; readonly value?: Uint8Array | undefined }>;
      cancel(): Promise<void>;
    };
  } | null;
  json(): Promise<unknown>;
}
declare function fetch(
  address: URL,
  init: {
    readonly method?: string;
    readonly headers?: Readonly<Record<string, string>>;
    readonly body?: string | ArrayBuffer;
    readonly signal?: AbortSignal;
  },
): Promise<FetchResponse>;
