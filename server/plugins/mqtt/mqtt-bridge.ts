/**
 * Keeps a broker's view of the plotters up to date, and performs the commands that it passes on.
 *
 *   <topic>/status              "online"; "offline" also if the server is killed or loses its network (last will)
 *   <topic>/<plotter>/state     a `PlotterReport`, when it changes, at most once a second
 *   <topic>/<plotter>/command   start, pause, resume, cancel
 *   <topic>/<plotter>/error     why a command was refused
 *
 * States are retained, so that whoever subscribes later has them. A retained command is ignored: the broker would repeat
 * it at each connection, and the plotter would start by itself. The log has the broker's host only, never user or password.
 */
import type { IClientPublishOptions, MqttClient } from "mqtt";
import type { Job } from "../../../src/schema/index.js";
import { packageVersion } from "../../storage/package-files.js";
import type { PluginHost } from "../server-plugin.js";
import {
  COMMANDS,
  commandTopic,
  discoveryOf,
  errorTopic,
  reportOf,
  stateTopic,
  statusTopic,
  type Broker,
  type MqttCommand,
} from "./broker.js";

type BridgeHost = Pick<PluginHost, "plotters" | "queue" | "log">;

const RETAINED: IClientPublishOptions = { qos: 1, retain: true };
/** Home Assistant announces its own start here, after which it wants to be told again what there is. */
const HOME_ASSISTANT = "homeassistant/status";
const EVERY_MS = 1_000;
const RECONNECT_MS = 5_000;
/** How long the end of the server waits for the broker. */
const CLOSING_MS = 2_000;

export class MqttBridge {
  private readonly client: MqttClient;
  /** What the broker has, by topic. */
  private readonly published = new Map<string, string>();
  /** The topics of each plotter that the broker was told about. */
  private readonly topicsOf = new Map<string, readonly string[]>();
  private timer: NodeJS.Timeout | null = null;
  private lastFault = "";

  constructor(
    mqtt: Pick<typeof import("mqtt"), "connect">,
    private readonly broker: Broker,
    private readonly host: BridgeHost,
  ) {
    const { url, username, password } = broker;
    this.client = mqtt.connect(url, {
      ...(username === undefined ? {} : { username }),
      ...(password === undefined ? {} : { password }),
      reconnectPeriod: RECONNECT_MS,
      // What was not delivered is out of date when the broker is back.
      queueQoSZero: false,
      will: { topic: statusTopic(broker), payload: Buffer.from("offline"), qos: 1, retain: true },
    });
    this.client.on("connect", () => this.connected());
    this.client.on("error", (error) => this.failed(error));
    this.client.on("message", (topic, payload, { retain }) =>
      this.received(topic, payload.toString("utf8"), retain),
    );
  }

  /** Call after each change of jobs and plotters. */
  changed(): void {
    this.timer ??= setTimeout(() => {
      this.timer = null;
      this.publishAll();
    }, EVERY_MS).unref();
  }

  async close(): Promise<void> {
    if (this.timer !== null) clearTimeout(this.timer);
    const { client } = this;
    if (client.connected) {
      const said = client.publishAsync(statusTopic(this.broker), "offline", RETAINED).catch(() => undefined);
      await Promise.race([said, new Promise((resolve) => setTimeout(resolve, CLOSING_MS).unref())]);
    }
    await client.endAsync(true);
  }

  private connected(): void {
    this.lastFault = "";
    this.host.log(`MQTT: connected to ${this.broker.name}`);
    // Another session: the broker may have lost what it had.
    this.published.clear();
    this.client.subscribe([commandTopic(this.broker, "+"), HOME_ASSISTANT], { qos: 1 }, (error) => {
      if (error !== null) this.failed(error);
    });
    this.publish(statusTopic(this.broker), "online");
    this.publishAll();
  }

  /** The same fault is logged once, not at each attempt. */
  private failed(error: Error): void {
    const { code } = error as NodeJS.ErrnoException;
    const fault = typeof code === "string" ? code : error.message;
    if (fault === this.lastFault) return;
    this.lastFault = fault;
    this.host.log(`MQTT: ${this.broker.name} can't be used: ${fault}. It is tried again every 5 s.`);
  }

  private publishAll(): void {
    if (!this.client.connected) return;
    const { plotters, queue } = this.host;
    const jobs = queue.list();
    for (const [id, topics] of this.topicsOf) if (!plotters.has(id)) this.forget(id, topics);
    for (const [id, port] of plotters) {
      const plotter = port.snapshot();
      const told = discoveryOf(this.broker, plotter, packageVersion());
      for (const [topic, config] of told) this.publish(topic, JSON.stringify(config));
      const topic = stateTopic(this.broker, id);
      this.publish(topic, JSON.stringify(reportOf(plotter, jobs)));
      this.topicsOf.set(id, [...told.keys(), topic]);
    }
  }

  /** Nothing, retained, removes a topic; Home Assistant then removes the entity. */
  private forget(id: string, topics: readonly string[]): void {
    for (const topic of topics) {
      this.publish(topic, "");
      this.published.delete(topic);
    }
    this.topicsOf.delete(id);
  }

  private publish(topic: string, text: string): void {
    if (this.published.get(topic) === text) return;
    this.published.set(topic, text);
    this.client.publish(topic, text, RETAINED, (error) => {
      // Published again with the next change, or after the next connection.
      if (error) this.published.delete(topic);
    });
  }

  private received(topic: string, text: string, isRetained: boolean): void {
    if (topic === HOME_ASSISTANT) {
      if (text !== "online") return;
      this.published.clear();
      return this.publishAll();
    }
    const id = [...this.host.plotters.keys()].find((one) => commandTopic(this.broker, one) === topic);
    if (id === undefined) return;
    if (isRetained) return this.refuse(id, "a retained command is ignored: publish it without retain");
    void this.perform(id, text.trim()).catch((error: unknown) => this.refuse(id, (error as Error).message));
  }

  private async perform(plotterId: string, text: string): Promise<void> {
    const command = COMMANDS.find((one) => one === text);
    if (command === undefined) {
      const shown = JSON.stringify(text.slice(0, MAX_SHOWN));
      return this.refuse(plotterId, `${shown} is not a command: there is ${COMMANDS.join(", ")}`);
    }
    const { queue } = this.host;
    const job = queue.list().find((one) => one.plotterId === plotterId && ON[command].includes(one.state));
    if (job === undefined) return this.refuse(plotterId, `${command}: no job is ${ON[command].join(" or ")}`);
    this.host.log(`MQTT: ${command} of ${JSON.stringify(job.name)}`);
    if (command === "start") await queue.start(job.id);
    else queue.plots[command](job.id);
  }

  private refuse(plotterId: string, why: string): void {
    this.host.log(`MQTT: ${why}`);
    this.client.publish(errorTopic(this.broker, plotterId), why, { qos: 1 });
  }
}

const MAX_SHOWN = 60;

/** The states of the job that a command is for. */
const ON: Readonly<Record<MqttCommand, readonly Job["state"][]>> = {
  start: ["queued"],
  pause: ["plotting"],
  resume: ["paused"],
  cancel: ["plotting", "paused"],
};
