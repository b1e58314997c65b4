/** Problems that no request could report, stored until a user dismisses them. */
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import { noticeSchema, type Notice, type ServerEvent } from "../../src/schema/index.js";
import type { SettingStore } from "../storage.js";

interface NoticeParts {
  readonly store: SettingStore;
  readonly announce: (event: ServerEvent) => void;
  readonly nowIso: () => string;
}

const SETTING = "notices";
const MAX_NOTICES = 50;

export class Notices {
  private kept: readonly Notice[];

  constructor(private readonly parts: NoticeParts) {
    const stored = z.array(noticeSchema).safeParse(parts.store.setting(SETTING));
    this.kept = stored.success ? stored.data : [];
  }

  /** Oldest first. */
  list(): Notice[] {
    return [...this.kept];
  }

  /** Returns its id. */
  add(message: string): string {
    const notice = { id: crypto.randomUUID(), at: this.parts.nowIso(), message };
    const list = [...this.kept, notice].slice(-MAX_NOTICES);
    try {
      this.save(list);
    } catch {
      // On a full disk the notice is still shown, until the server ends.
      this.kept = list;
    }
    this.parts.announce({ type: "notice", notice });
    return notice.id;
  }

  /** Throws `not-found`. */
  remove(id: string): void {
    const left = this.kept.filter((notice) => notice.id !== id);
    if (left.length === this.kept.length) {
      throw new PlotwrightError("not-found", `There is no notice ${id}.`);
    }
    this.save(left);
    this.parts.announce({ type: "notice-removed", id });
  }

  private save(list: readonly Notice[]): void {
    this.parts.store.saveSetting(SETTING, list);
    this.kept = list;
  }
}
