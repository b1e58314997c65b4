/** Sessions, keys and pairing links, without a server. */
import { describe, expect, it, vi } from "vitest";
import { Access } from "../../../server/security/access.js";
import type { AccessEntry, Role } from "../../../src/schema/index.js";

/** Keeps its settings, and counts how often they are written. */
class FakeStore {
  writeCount = 0;
  isFull = false;
  private value: unknown;
  setting(): unknown {
    return this.value;
  }
  saveSetting(_key: string, value: unknown): void {
    if (this.isFull) throw new Error("disk full");
    this.value = structuredClone(value);
    this.writeCount++;
  }
}

function newAccess() {
  let nowMs = Date.parse("2026-01-01T00:00:00Z");
  const store = new FakeStore();
  const access = new Access(store, { now: () => new Date(nowMs) });
  const pair = (role: Role, before: string | null = null): string =>
    access.pair(access.pairingPath(role).split("=")[1] ?? "", "phone", before);
  const entry = (secret: string): AccessEntry => access.entryOf(secret)!;
  return { store, access, pair, entry, pass: (ms: number) => (nowMs += ms) };
}

describe("a device that is paired again", () => {
  it("keeps its id in the same role only, and the streams of its earlier session end", () => {
    const { access, pair, entry } = newAccess();
    const ended = vi.fn();
    access.onRevoke(ended);
    const other = pair("submit");
    const first = pair("submit");
    const { id } = entry(first);
    const second = pair("submit", first);
    expect(entry(second).id).toBe(id);
    const third = pair("watch", second);
    expect(entry(third).id).not.toBe(id);
    expect([first, second].map((secret) => access.roleOf(secret))).toEqual([null, null]);
    expect(access.roleOf(other)).toBe("submit");
    expect(ended.mock.calls).toEqual([[id], [id]]);
  });

  it("ends no key, although it sends the key's secret as its cookie", () => {
    const { access, pair } = newAccess();
    const { secret } = access.createKey("script", "operate");
    pair("watch", secret);
    expect(access.roleOf(secret)).toBe("operate");
  });
});

describe("keys", () => {
  it("are limited to 100, however many sessions there are", () => {
    const { access, pair } = newAccess();
    for (let count = 0; count < 100; count++) pair("submit");
    for (let count = 0; count < 100; count++) access.createKey(`key ${count}`, "watch");
    expect(() => access.createKey("one more", "watch")).toThrow("There are 100 keys already");
    access.revoke(access.list().find(({ kind }) => kind === "key")!.id);
    access.createKey("one more", "watch");
  });

  it("have names of at most 200 characters", () => {
    expect(newAccess().access.createKey("x".repeat(1_000), "watch").entry.name).toBe("x".repeat(200));
  });
});

describe("revoking", () => {
  it("replaces the pairing links if it was a session, and tells who shows them", () => {
    const { access, pair, entry } = newAccess();
    const replaced = vi.fn();
    access.onNewPairing(replaced);
    const links = (): string[] =>
      (["operate", "submit", "watch"] as const).map((role) => access.pairingPath(role));
    const before = links();
    access.revoke(access.createKey("script", "operate").entry.id);
    expect(links()).toEqual(before);
    expect(replaced).not.toHaveBeenCalled();
    access.revoke(entry(pair("watch")).id);
    expect(new Set([...before, ...links()]).size).toBe(6);
    expect(replaced).toHaveBeenCalledOnce();
  });

  it("fails for an id that does not exist, and changes nothing", () => {
    const { access, pair } = newAccess();
    const secret = pair("watch");
    expect(() => access.revoke("x")).toThrow("There is no access x");
    expect(access.roleOf(secret)).toBe("watch");
  });
});

describe("the time of last use", () => {
  it("is stored at most once a minute, of the one that was used", () => {
    const { store, access, pair, entry, pass } = newAccess();
    const [used, other] = [pair("watch"), pair("watch")];
    const begun = store.writeCount;
    for (let request = 0; request < 10; request++) access.roleOf(used);
    pass(60_000);
    access.roleOf(used);
    expect(store.writeCount).toBe(begun);
    pass(1);
    for (let request = 0; request < 10; request++) access.roleOf(used);
    expect(store.writeCount).toBe(begun + 1);
    expect(access.list().map(({ lastSeenAt }) => lastSeenAt)).toEqual([
      "2026-01-01T00:01:00.001Z",
      "2026-01-01T00:00:00.000Z",
    ]);
    expect(entry(other).id).not.toBe(entry(used).id);
  });

  it("may be lost on a full disk, but the device is still known, since it may have to stop a plot", () => {
    const { store, access, pair, pass } = newAccess();
    const secret = pair("watch");
    store.isFull = true;
    pass(3_600_000);
    expect(access.roleOf(secret)).toBe("watch");
  });
});

it("a store without entries, or with damaged ones, lets nobody in", () => {
  for (const value of [undefined, null, [{ id: "a" }], [{ secretSha256: "" }], "x"]) {
    const access = new Access({ setting: () => value, saveSetting: () => undefined });
    expect(access.list()).toEqual([]);
    expect(["", "undefined", "null"].map((secret) => access.roleOf(secret))).toEqual([null, null, null]);
  }
});
