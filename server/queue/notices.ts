/** What went wrong with nobody asking, kept until somebody has read it. */
import { randomUUID } from "node:crypto";
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import { noticeSchema, type Notice, type ServerEvent } from "../../src/schema/index.js";
import type { Store } from "./store.js";

export interface NoticeParts {
  readonly store: Pick<Store, "setting" | "saveSetting">;
  readonly announce: (event: ServerEvent) => void;
  readonly nowIso: () => string;
}

const SETTING = "notices";
const MOST = 50;

export class Notices {
  readonly #parts: NoticeParts;
  #list: readonly Notice[];

  constructor(parts: NoticeParts) {
    this.#parts = parts;
    const kept = z.array(noticeSchema).safeParse(parts.store.setting(SETTING));
    this.#list = kept.success ? kept.data : [];
  }

  /** Oldest first. */
  list(): Notice[] {
    return [...this.#list];
  }

  add(message: string): void {
    const notice = { id: randomUUID(), at: this.#parts.nowIso(), message };
    const list = [...this.#list, notice].slice(-MOST);
    try {
      this.#save(list);
    } catch {
      // On a full disk it is still shown, until the server ends.
      this.#list = list;
    }
    this.#parts.announce({ type: "notice", notice });
  }

  /** Throws `not-found`. */
  remove(id: string): void {
    const left = this.#list.filter((notice) => notice.id !== id);
    if (left.length === this.#list.length) {
      throw new PlotwrightError("not-found", `There is no notice ${id}.`);
    }
    this.#save(left);
    this.#parts.announce({ type: "notice-removed", id });
  }

  #save(list: readonly Notice[]): void {
    this.#parts.store.saveSetting(SETTING, list);
    this.#list = list;
  }
}
