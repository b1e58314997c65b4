/** Webhooks and their pending deliveries, in the server's database. */
import type { Database } from "node-sqlite3-wasm";
import {
  webhookEventSchema,
  webhookProgressSchema,
  webhookSchema,
  type Webhook,
  type WebhookEvent,
} from "../../../src/schema/index.js";

type Row = Record<string, number | bigint | string | Uint8Array | null>;

export interface Delivery {
  readonly id: string;
  readonly webhookId: string;
  readonly event: WebhookEvent;
  /** The exact JSON text that is signed and sent. */
  readonly body: string;
  readonly tryCount: number;
  /** ms since 1970. */
  readonly nextAtMs: number;
}

export class WebhookStore {
  constructor(private readonly db: Database) {}

  list(): Webhook[] {
    return this.all(
      `SELECT w.*, (SELECT COUNT(*) FROM deliveries d WHERE d.webhook_id = w.id) AS pending
       FROM webhooks w ORDER BY created_at`,
    ).map((row) =>
      webhookSchema.parse({
        id: row["id"],
        name: row["name"],
        url: row["url"],
        events: knownEvents(String(row["events"])),
        progress: webhookProgressSchema.parse(
          row["progress"] === null ? {} : JSON.parse(String(row["progress"])),
        ),
        createdAt: row["created_at"],
        pendingCount: Number(row["pending"]),
        last: row["last"] === null ? null : (JSON.parse(String(row["last"])) as unknown),
      }),
    );
  }

  secretOf(id: string): string | null {
    const row = this.db.get("SELECT secret FROM webhooks WHERE id = ?", [id]) as Row | null;
    return row === null ? null : String(row["secret"]);
  }

  add({ id, name, url, events, progress, createdAt }: Webhook, secret: string): void {
    this.db.run(
      "INSERT INTO webhooks (id, name, url, events, progress, created_at, secret) VALUES (?, ?, ?, ?, ?, ?, ?)",
      [id, name, url, JSON.stringify(events), JSON.stringify(progress), createdAt, secret],
    );
  }

  /** Removes the webhook with its pending deliveries. False if there is no such webhook. */
  remove(id: string): boolean {
    this.db.run("DELETE FROM deliveries WHERE webhook_id = ?", [id]);
    this.db.run("DELETE FROM webhooks WHERE id = ?", [id]);
    return Number((this.db.get("SELECT changes() AS n") as Row)["n"]) > 0;
  }

  saveLast(id: string, last: Webhook["last"]): void {
    this.db.run("UPDATE webhooks SET last = ? WHERE id = ?", [JSON.stringify(last), id]);
  }

  addDelivery({ id, webhookId, event, body, tryCount, nextAtMs }: Delivery): void {
    this.db.run(
      "INSERT INTO deliveries (id, webhook_id, event, body, try_count, next_at_ms) VALUES (?, ?, ?, ?, ?, ?)",
      [id, webhookId, event, body, tryCount, nextAtMs],
    );
  }

  /** Oldest first: deliveries are made in order. */
  deliveries(webhookId: string): Delivery[] {
    return this.all("SELECT * FROM deliveries WHERE webhook_id = ? ORDER BY rowid", [webhookId]).map(
      (row) => ({
        id: String(row["id"]),
        webhookId,
        event: String(row["event"]) as WebhookEvent,
        body: String(row["body"]),
        tryCount: Number(row["try_count"]),
        nextAtMs: Number(row["next_at_ms"]),
      }),
    );
  }

  delay(id: string, tryCount: number, nextAtMs: number): void {
    this.db.run("UPDATE deliveries SET try_count = ?, next_at_ms = ? WHERE id = ?", [tryCount, nextAtMs, id]);
  }

  removeDelivery(id: string): void {
    this.db.run("DELETE FROM deliveries WHERE id = ?", [id]);
  }

  private all(sql: string, values: (string | number)[] = []): Row[] {
    return this.db.all(sql, values) as Row[];
  }
}

/** Without events that only another version of plotwright has. */
const knownEvents = (json: string): unknown[] =>
  (JSON.parse(json) as unknown[]).filter((event) => webhookEventSchema.safeParse(event).success);
