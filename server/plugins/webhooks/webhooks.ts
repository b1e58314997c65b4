/**
 * Notifies other programs by HTTP when a job starts, is done, waits for the user, or has failed, and of its progress.
 *
 * Each message is stored in the same transaction as the job's change, so no crash can lose it. It is removed
 * only after the receiver has answered 2xx, so after a crash it may be sent twice (with the same id). Each
 * webhook gets one message at a time, in order. After each failed try the pause is longer; other webhooks are
 * not delayed. Of a job's progress only the newest message waits: an older one would say nothing more.
 *
 *   Plotwright-Signature: t=SECONDS,v1=HEX      HMAC-SHA256 of "SECONDS.BODY" with the webhook's secret
 *
 * The time is signed too, so that a receiver can refuse replayed messages. Redirects are not followed,
 * because the body would go to an address that the user has not chosen. Logs contain only the host of the
 * address, because the rest is a secret with many services.
 */
import { createHmac, randomBytes, randomUUID } from "node:crypto";
import { PlotwrightError } from "../../../src/index.js";
import type { z } from "zod";
import type {
  Job,
  newWebhookSchema,
  Webhook,
  WebhookEvent,
  WebhookMessage,
} from "../../../src/schema/index.js";
import { isOnPlotter } from "../../../host/queue/job-states.js";
import type { Delivery, WebhookStore } from "./webhook-store.js";

interface WebhookParts {
  readonly store: WebhookStore;
  readonly plotterName: (id: string) => string;
  readonly log: (line: string) => void;
  readonly nowMs?: () => number;
  /** Pause after each failed try. When the try after the last pause fails, the message is dropped. */
  readonly pausesS?: readonly number[];
}

/** About three days in total. */
const PAUSES_S = [5, 30, 120, 600, 3_600, 21_600, 43_200, 86_400, 86_400];
const TIMEOUT_MS = 10_000;

interface Try {
  readonly isDelivered: boolean;
  /** The receiver answered 410 Gone. */
  readonly isGone: boolean;
  readonly message: string;
}

export class Webhooks {
  private readonly nowMs: () => number;
  /** By webhook id: the timer of the next delivery, or null during a delivery. */
  private readonly busy = new Map<string, NodeJS.Timeout | null>();
  private readonly abort = new AbortController();
  private readonly running = new Set<Promise<void>>();
  /** Those that want progress; null: to be read again. */
  private ofProgress: readonly Webhook[] | null = null;
  /** What was last said of a job's progress, by "webhook job". */
  private readonly told = new Map<string, { readonly progress: number; readonly atMs: number }>();

  constructor(private readonly parts: WebhookParts) {
    this.nowMs = parts.nowMs ?? Date.now;
  }

  /** Resumes deliveries left by an earlier run of the server. */
  start(): void {
    for (const { id } of this.list()) this.next(id);
  }

  list(): Webhook[] {
    return this.parts.store.list();
  }

  /** The secret is returned only here and never shown again. */
  add({ name, url, events, progress }: z.output<typeof newWebhookSchema>): {
    readonly webhook: Webhook;
    readonly secret: string;
  } {
    const webhook: Webhook = {
      id: randomUUID(),
      name,
      url,
      events: [...new Set(events)],
      progress,
      createdAt: new Date(this.nowMs()).toISOString(),
      pendingCount: 0,
      last: null,
    };
    const secret = randomBytes(32).toString("base64url");
    this.parts.store.add(webhook, secret);
    this.ofProgress = null;
    return { webhook, secret };
  }

  /** Throws `not-found`. */
  remove(id: string): void {
    if (!this.parts.store.remove(id)) throw new PlotwrightError("not-found", `There is no webhook ${id}.`);
    this.ofProgress = null;
    const timer = this.busy.get(id) ?? null;
    if (timer !== null) clearTimeout(timer);
    if (timer !== null) this.busy.delete(id);
  }

  /** Call inside the transaction that stores the job; stores the messages without sending them. */
  note(before: Job | null, after: Job): void {
    if (!isOnPlotter(after)) this.forgetProgress(after.id);
    const event = eventOf(before, after);
    if (event === null) return;
    for (const webhook of this.list()) {
      if (webhook.events.includes(event)) this.addDelivery(webhook.id, event, after);
    }
  }

  /** Call with every report of a running job. Stores and sends a message if it is time for one. */
  progressed(job: Job): void {
    try {
      this.tellProgress(job);
    } catch (error) {
      // A full disk must not end the plot.
      this.parts.log(`webhooks: ${String(error)}`);
    }
  }

  private tellProgress(job: Job): void {
    this.ofProgress ??= this.list().filter(({ events }) => events.includes("progress"));
    for (const { id, progress } of this.ofProgress) {
      const key = `${id} ${job.id}`;
      const now = { progress: job.progress, atMs: this.nowMs() };
      const last = this.told.get(key);
      if (last === undefined) this.told.set(key, now);
      const isDue =
        last !== undefined &&
        now.progress - last.progress >= progress.everyPct / 100 &&
        now.atMs - last.atMs >= progress.everyS * 1000;
      if (!isDue) continue;
      this.told.set(key, now);
      this.replaceProgress(id, job);
      this.next(id);
    }
  }

  /** A message that waits for its next try is replaced, and the new one waits as long. */
  private replaceProgress(webhookId: string, job: Job): void {
    const { store } = this.parts;
    const isBeingSent = this.busy.get(webhookId) === null;
    const waiting = store.deliveries(webhookId).slice(isBeingSent ? 1 : 0);
    const old = waiting.find(({ event, body }) => event === "progress" && jobIdIn(body) === job.id);
    if (old !== undefined) store.removeDelivery(old.id);
    this.addDelivery(webhookId, "progress", job, old);
  }

  private forgetProgress(jobId: string): void {
    for (const key of this.told.keys()) if (key.endsWith(` ${jobId}`)) this.told.delete(key);
  }

  private addDelivery(
    webhookId: string,
    event: WebhookEvent,
    job: Job,
    { tryCount, nextAtMs }: Pick<Delivery, "tryCount" | "nextAtMs"> = { tryCount: 0, nextAtMs: this.nowMs() },
  ): void {
    const id = randomUUID();
    const body = JSON.stringify(this.message(id, event, job));
    this.parts.store.addDelivery({ id, webhookId, event, body, tryCount, nextAtMs });
  }

  /** Call after that transaction; starts sending. */
  wake(): void {
    for (const { id, pendingCount } of this.list()) if (pendingCount > 0) this.next(id);
  }

  /** Undelivered messages remain stored for the next start. */
  async close(): Promise<void> {
    this.abort.abort();
    for (const timer of this.busy.values()) if (timer !== null) clearTimeout(timer);
    await Promise.all(this.running);
  }

  private message(id: string, event: WebhookEvent, job: Job): WebhookMessage {
    const { wait, plotterId } = job;
    return {
      id,
      event,
      at: new Date(this.nowMs()).toISOString(),
      job: {
        id: job.id,
        name: job.name,
        state: job.state,
        message: job.message,
        progress: job.progress,
        remainingS: job.remainingS,
        wait: wait === null ? null : `${wait.penName ?? "pen"} for ${wait.layerName}`,
      },
      plotter: { id: plotterId, name: this.parts.plotterName(plotterId) },
    };
  }

  private next(webhookId: string): void {
    if (this.busy.has(webhookId) || this.abort.signal.aborted) return;
    const [first] = this.parts.store.deliveries(webhookId);
    if (first === undefined) return;
    const pauseMs = Math.max(0, first.nextAtMs - this.nowMs());
    const timer = setTimeout(() => {
      this.busy.set(webhookId, null);
      // Another one, if progress was replaced.
      const [now = first] = this.parts.store.deliveries(webhookId);
      const run = this.deliver(now)
        .finally(() => {
          this.running.delete(run);
          this.busy.delete(webhookId);
        })
        .then(() => this.next(webhookId))
        // The cause may be a full disk, so an immediate retry would loop. The next change of a job tries again.
        .catch((error: unknown) => this.parts.log(`webhooks: ${String(error)}`));
      this.running.add(run);
    }, pauseMs);
    timer.unref();
    this.busy.set(webhookId, timer);
  }

  private async deliver(delivery: Delivery): Promise<void> {
    const { store, log, pausesS = PAUSES_S } = this.parts;
    const webhook = this.list().find(({ id }) => id === delivery.webhookId);
    const secret = store.secretOf(delivery.webhookId);
    if (webhook === undefined || secret === null) return;
    const { isDelivered, isGone, message } = await this.post(webhook.url, secret, delivery);
    // Stopped during the request: it is unknown whether the message arrived, so it is sent again after a
    // restart.
    if (this.abort.signal.aborted) return;
    const at = new Date(this.nowMs()).toISOString();
    store.saveLast(webhook.id, { at, isDelivered, message });
    if (isDelivered) {
      store.removeDelivery(delivery.id);
      return;
    }
    const pauseS = pausesS[delivery.tryCount];
    const who = `webhook ${JSON.stringify(webhook.name)} (${new URL(webhook.url).host})`;
    if (isGone || pauseS === undefined) {
      log(`${who}: ${message}; gave up on "${delivery.event}"`);
      store.removeDelivery(delivery.id);
    } else {
      log(`${who}: ${message}; next try in ${pauseS} s`);
      store.delay(delivery.id, delivery.tryCount + 1, this.nowMs() + pauseS * 1000);
    }
  }

  private async post(url: string, secret: string, { id, event, body }: Delivery): Promise<Try> {
    const timeS = Math.floor(this.nowMs() / 1000);
    try {
      const response = await fetch(url, {
        method: "POST",
        body,
        redirect: "manual",
        signal: AbortSignal.any([this.abort.signal, AbortSignal.timeout(TIMEOUT_MS)]),
        headers: {
          "Content-Type": "application/json",
          "User-Agent": "plotwright",
          "Plotwright-Event": event,
          "Plotwright-Delivery": id,
          "Plotwright-Signature": `t=${timeS},v1=${signatureOf(secret, timeS, body)}`,
        },
      });
      await response.body?.cancel();
      const { status } = response;
      const isRedirect = status >= 300 && status < 400;
      return {
        isDelivered: response.ok,
        isGone: status === 410,
        message: isRedirect ? `answered ${status}: redirects are not followed` : `answered ${status}`,
      };
    } catch (error) {
      return { isDelivered: false, isGone: false, message: reason(error) };
    }
  }
}

export const signatureOf = (secret: string, timeS: number, body: string): string =>
  createHmac("sha256", secret).update(`${timeS}.${body}`).digest("hex");

const jobIdIn = (body: string): string => (JSON.parse(body) as WebhookMessage).job.id;

/** An interrupted job counts as waiting, because it needs the user to continue. */
function eventOf(before: Job | null, after: Job): WebhookEvent | null {
  const isNew = before?.state !== after.state;
  if (before?.state === "queued" && after.state === "plotting") return "started";
  if (after.state === "done") return isNew ? "done" : null;
  if (after.state === "failed") return isNew ? "failed" : null;
  if (after.state === "interrupted") return isNew ? "waiting" : null;
  const waitsNow = after.state === "paused" && after.wait !== null;
  // A recovered job still has the wait from before, which was already reported.
  const waitedBefore = before?.wait !== null && before !== null;
  return waitsNow && !waitedBefore ? "waiting" : null;
}

/** Reports only a code such as ECONNREFUSED, because the error message of fetch may contain the address. */
function reason(error: unknown): string {
  if (error instanceof Error && error.name === "TimeoutError") return "did not answer";
  const cause = error instanceof Error ? error.cause : undefined;
  const code = (cause as NodeJS.ErrnoException | undefined)?.code;
  return typeof code === "string" ? `could not be reached (${code})` : "could not be reached";
}
