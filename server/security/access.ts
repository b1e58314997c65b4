/**
 * Access control when the server listens on the network.
 *
 *   loopback     this computer: may do everything, as its user could anyway
 *   pairing      a link with a secret, printed by the server (also as a QR code): opens a session in a browser. All
 *                links are replaced when a session is revoked: its device knows the old one
 *   session      a cookie that only this server's pages send (HttpOnly, SameSite=Strict); can be revoked, and ends
 *                SESSION_DAYS after the pairing. A device has one: pairing it again replaces the earlier one, whose id
 *                it keeps in the same role, so that the jobs that it has submitted stay its own
 *   key          "Authorization: Bearer …" for scripts; created by an operator, shown once, can be revoked
 *
 * Secrets are stored as SHA-256. They are 256 random bits, so a slow hash would add nothing.
 */
import { createHash, randomBytes } from "node:crypto";
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import { ROLES, accessEntrySchema, type AccessEntry, type Role } from "../../src/schema/index.js";
import type { Store } from "../storage/store.js";

const storedSchema = z.array(accessEntrySchema.extend({ secretSha256: z.string() }));
type StoredEntry = z.infer<typeof storedSchema>[number];

/** The browser forgets its cookie then, and the server the session: a copy of the cookie is worth no more. */
export const SESSION_DAYS = 90;

/** Max sessions of each role. Beyond that, the one that was not used for the longest time ends. */
const MAX_SESSIONS = 100;
const MAX_KEYS = 100;

const SETTING = "access";
/** The time of last use is stored at most once per minute: a write per request would wear out the disk. */
const SEEN_EVERY_MS = 60_000;

export class Access {
  /** Requests from this computer need no pairing. */
  readonly trustsLoopback: boolean;
  private readonly now: () => Date;
  /** By the hash of their secrets, so that a request needs one look-up. */
  private entries: ReadonlyMap<string, StoredEntry>;
  private pairing = newPairing();
  private revokeListener: (id: string) => void = () => undefined;
  private pairingListener: () => void = () => undefined;

  constructor(
    private readonly store: Pick<Store, "setting" | "saveSetting">,
    options: { readonly trustsLoopback?: boolean | undefined; readonly now?: () => Date } = {},
  ) {
    this.now = options.now ?? (() => new Date());
    this.trustsLoopback = options.trustsLoopback ?? true;
    const stored = storedSchema.safeParse(store.setting(SETTING));
    this.entries = byHash(stored.success ? stored.data : []);
  }

  /**
   * Path of the link that opens a session with that role in a browser; valid until the server ends or a session is
   * revoked.
   */
  pairingPath(role: Role): string {
    return `/pair?token=${this.pairing[role]}`;
  }

  /**
   * Opens a session for a pairing token; throws `not-allowed`. Returns the cookie's secret. `before` is the secret that
   * the device already has: that session ends.
   */
  pair(token: string, name: string, before: string | null): string {
    // Compared as hashes, so that the time says nothing about the tokens.
    const role = ROLES.find((one) => hashOf(this.pairing[one]) === hashOf(token));
    if (role === undefined) {
      throw new PlotwrightError(
        "not-allowed",
        "This link is no longer valid. Use the one the server shows now.",
      );
    }
    const entries = this.valid();
    const beforeSha256 = before === null ? null : hashOf(before);
    const isBefore = (entry: StoredEntry): boolean =>
      entry.kind === "session" && entry.secretSha256 === beforeSha256;
    const others = entries.filter((entry) => !isBefore(entry));
    const kept = withRoom(others, role);
    const again = entries.find((entry) => isBefore(entry) && entry.role === role);
    const { secret } = this.add("session", role, name, kept, again?.id);
    for (const { id } of entries.filter((entry) => !kept.includes(entry))) this.revokeListener(id);
    return secret;
  }

  /** Throws `conflict` if there are too many keys. */
  createKey(name: string, role: Role): { readonly entry: AccessEntry; readonly secret: string } {
    const entries = this.valid();
    if (entries.filter(({ kind }) => kind === "key").length >= MAX_KEYS) {
      throw new PlotwrightError("conflict", `There are ${MAX_KEYS} keys already. Revoke one of them first.`);
    }
    return this.add("key", role, name, entries);
  }

  list(): AccessEntry[] {
    return this.valid().map(publicPart);
  }

  /** Throws `not-found`. Revoking a session also replaces the pairing links. */
  revoke(id: string): void {
    const entries = [...this.entries.values()];
    const revoked = entries.find((entry) => entry.id === id);
    if (revoked === undefined) throw new PlotwrightError("not-found", `There is no access ${id}.`);
    this.save(entries.filter((entry) => entry !== revoked));
    this.revokeListener(id);
    if (revoked.kind === "key") return;
    this.pairing = newPairing();
    this.pairingListener();
  }

  /** Sets the listener called with the id of a session or key that ends, so that its open streams can be ended. */
  onRevoke(listener: (id: string) => void): void {
    this.revokeListener = listener;
  }

  /** Sets the listener called when the pairing links were replaced. */
  onNewPairing(listener: () => void): void {
    this.pairingListener = listener;
  }

  /** The role of a secret; null if the secret is unknown. */
  roleOf(secret: string): Role | null {
    return this.entryOf(secret)?.role ?? null;
  }

  /** The session or key with this secret; null if the secret is unknown. */
  entryOf(secret: string): AccessEntry | null {
    // The time of this look-up depends on the hash, from which the secret can't be found.
    const entry = this.entries.get(hashOf(secret));
    if (entry === undefined || !this.isValid(entry)) return null;
    const now = this.now();
    if (now.getTime() - Date.parse(entry.lastSeenAt) > SEEN_EVERY_MS) this.saveSeen(entry, now);
    return publicPart(entry);
  }

  /** Ignores a full disk: a device that wants to stop a plot must not be refused because of it. */
  private saveSeen(seen: StoredEntry, now: Date): void {
    const lastSeenAt = now.toISOString();
    const entries = [...this.entries.values()];
    try {
      this.save(entries.map((entry) => (entry === seen ? { ...entry, lastSeenAt } : entry)));
    } catch {
      return;
    }
  }

  private add(
    kind: AccessEntry["kind"],
    role: Role,
    name: string,
    others: readonly StoredEntry[],
    id = randomBytes(8).toString("hex"),
  ): { entry: AccessEntry; secret: string } {
    const secret = newSecret();
    const at = this.now().toISOString();
    const entry: AccessEntry = {
      id,
      kind,
      role,
      name: name.slice(0, 200),
      createdAt: at,
      lastSeenAt: at,
    };
    this.save([...others, { ...entry, secretSha256: hashOf(secret) }]);
    return { entry, secret };
  }

  /** All entries but the sessions that have ended. They leave the store when the next session or key is added. */
  private valid(): StoredEntry[] {
    return [...this.entries.values()].filter((entry) => this.isValid(entry));
  }

  private isValid({ kind, createdAt }: StoredEntry): boolean {
    return kind === "key" || Date.parse(createdAt) > this.now().getTime() - SESSION_DAYS * 86_400_000;
  }

  private save(entries: readonly StoredEntry[]): void {
    this.store.saveSetting(SETTING, entries);
    this.entries = byHash(entries);
  }
}

const newSecret = (): string => randomBytes(32).toString("base64url");
const hashOf = (secret: string): string => createHash("sha256").update(secret).digest("hex");

const byHash = (entries: readonly StoredEntry[]): ReadonlyMap<string, StoredEntry> =>
  new Map(entries.map((entry) => [entry.secretSha256, entry]));

const newPairing = (): Readonly<Record<Role, string>> => ({
  operate: newSecret(),
  submit: newSecret(),
  watch: newSecret(),
});

/** The entries without the least recently used sessions of a role, so that another one can be added. */
function withRoom(entries: readonly StoredEntry[], role: Role): StoredEntry[] {
  const sessions = entries.filter((entry) => entry.kind === "session" && entry.role === role);
  const oldestFirst = sessions.sort((a, b) => Date.parse(a.lastSeenAt) - Date.parse(b.lastSeenAt));
  const ended = new Set(oldestFirst.slice(0, Math.max(0, sessions.length - MAX_SESSIONS + 1)));
  return entries.filter((entry) => !ended.has(entry));
}

function publicPart(entry: StoredEntry): AccessEntry {
  const { id, kind, role, name, createdAt, lastSeenAt } = entry;
  return { id, kind, role, name, createdAt, lastSeenAt };
}
