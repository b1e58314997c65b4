/**
 * Access control when the server listens on the network.
 *
 *   loopback     this computer: may do everything, as its user could anyway
 *   pairing      a link with a secret, printed by the server (also as a QR code): opens a session in a browser
 *   session      a cookie that only this server's pages send (HttpOnly, SameSite=Strict); can be revoked, and ends
 *                SESSION_DAYS after the pairing
 *   key          "Authorization: Bearer …" for scripts; created by an operator, shown once, can be revoked
 *
 * Secrets are stored as SHA-256. They are 256 random bits, so a slow hash would add nothing.
 */
import { createHash, randomBytes, timingSafeEqual } from "node:crypto";
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import { accessEntrySchema, type AccessEntry, type Role } from "../../src/schema/index.js";
import type { Store } from "../storage/store.js";

const storedSchema = z.array(accessEntrySchema.extend({ secretSha256: z.string() }));
type StoredEntry = z.infer<typeof storedSchema>[number];

/** The browser forgets its cookie then, and the server the session: a copy of the cookie is worth no more. */
export const SESSION_DAYS = 90;

const SETTING = "access";
/** The time of last use is stored at most once per minute: a write per request would wear out the disk. */
const SEEN_EVERY_MS = 60_000;

export class Access {
  /** Requests from this computer need no pairing. */
  readonly trustsLoopback: boolean;
  readonly #store: Pick<Store, "setting" | "saveSetting">;
  readonly #now: () => Date;
  #entries: StoredEntry[];
  readonly #pairing: ReadonlyMap<Role, string> = new Map([
    ["operate", newSecret()],
    ["watch", newSecret()],
  ]);

  #onRevoke: () => void = () => undefined;

  constructor(
    store: Pick<Store, "setting" | "saveSetting">,
    options: { readonly trustsLoopback?: boolean | undefined; readonly now?: () => Date } = {},
  ) {
    this.#store = store;
    this.#now = options.now ?? (() => new Date());
    this.trustsLoopback = options.trustsLoopback ?? true;
    const stored = storedSchema.safeParse(store.setting(SETTING));
    this.#entries = stored.success ? stored.data : [];
  }

  /** Path of the link that opens a session with that role in a browser; valid until the server ends. */
  pairingPath(role: Role): string {
    return `/pair?token=${this.#pairing.get(role) ?? ""}`;
  }

  /** Opens a session for a pairing token; throws `not-allowed`. Returns the cookie's secret. */
  pair(token: string, name: string): string {
    for (const [role, secret] of this.#pairing) {
      if (equal(token, secret)) return this.#add("session", role, name).secret;
    }
    throw new PlotwrightError(
      "not-allowed",
      "This link is no longer valid. Use the one the server shows now.",
    );
  }

  createKey(name: string, role: Role): { readonly entry: AccessEntry; readonly secret: string } {
    return this.#add("key", role, name);
  }

  list(): AccessEntry[] {
    return this.#valid().map(publicPart);
  }

  /** Throws `not-found`. */
  revoke(id: string): void {
    const left = this.#entries.filter((entry) => entry.id !== id);
    if (left.length === this.#entries.length)
      throw new PlotwrightError("not-found", `There is no access ${id}.`);
    this.#save(left);
    this.#onRevoke();
  }

  /** Sets the listener called after a session or key was revoked, so that its open streams can be ended. */
  onRevoke(listener: () => void): void {
    this.#onRevoke = listener;
  }

  /** The role of a secret; null if the secret is unknown. */
  roleOf(secret: string): Role | null {
    return this.entryOf(secret)?.role ?? null;
  }

  /** The session or key with this secret; null if the secret is unknown. */
  entryOf(secret: string): AccessEntry | null {
    const sha256 = hashOf(secret);
    const entry = this.#valid().find(({ secretSha256 }) => equal(secretSha256, sha256));
    if (entry === undefined) return null;
    const now = this.#now();
    if (now.getTime() - Date.parse(entry.lastSeenAt) > SEEN_EVERY_MS) this.#saveSeen(entry, now);
    return publicPart(entry);
  }

  /** Ignores a full disk: a device that wants to stop a plot must not be refused because of it. */
  #saveSeen(seen: StoredEntry, now: Date): void {
    const lastSeenAt = now.toISOString();
    try {
      this.#save(this.#entries.map((entry) => (entry === seen ? { ...entry, lastSeenAt } : entry)));
    } catch {
      return;
    }
  }

  #add(kind: AccessEntry["kind"], role: Role, name: string): { entry: AccessEntry; secret: string } {
    const secret = newSecret();
    const at = this.#now().toISOString();
    const entry: AccessEntry = {
      id: randomBytes(8).toString("hex"),
      kind,
      role,
      name: name.slice(0, 200),
      createdAt: at,
      lastSeenAt: at,
    };
    this.#save([...this.#valid(), { ...entry, secretSha256: hashOf(secret) }]);
    return { entry, secret };
  }

  /** All entries but the sessions that have ended. They leave the store when the next session or key is added. */
  #valid(): StoredEntry[] {
    const oldest = this.#now().getTime() - SESSION_DAYS * 86_400_000;
    return this.#entries.filter(({ kind, createdAt }) => kind === "key" || Date.parse(createdAt) > oldest);
  }

  #save(entries: StoredEntry[]): void {
    this.#store.saveSetting(SETTING, entries);
    this.#entries = entries;
  }
}

const newSecret = (): string => randomBytes(32).toString("base64url");
const hashOf = (secret: string): string => createHash("sha256").update(secret).digest("hex");

/** Compares in constant time. Both are hashed because timingSafeEqual needs equal lengths. */
function equal(a: string, b: string): boolean {
  return timingSafeEqual(createHash("sha256").update(a).digest(), createHash("sha256").update(b).digest());
}

function publicPart(entry: StoredEntry): AccessEntry {
  const { id, kind, role, name, createdAt, lastSeenAt } = entry;
  return { id, kind, role, name, createdAt, lastSeenAt };
}
