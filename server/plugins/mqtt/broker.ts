/** The address of an MQTT broker, and what a broker is told about a plotter: topics, state, Home Assistant's entities. */
import { PlotwrightError } from "../../../src/index.js";
import type { Job, Plotter } from "../../../src/schema/index.js";

export interface Broker {
  /** Without user, password and topic. */
  readonly url: string;
  /** For the log. */
  readonly name: string;
  readonly username?: string;
  readonly password?: string;
  /** The first part of all topics. */
  readonly topic: string;
}

const DEFAULT_TOPIC = "plotwright";

/**
 * Reads `mqtts://user:password@host:8883/topic`. The error names no part of the address, which may have a password.
 *
 * @throws PlotwrightError "bad-setting"
 */
export function brokerAt(address: string): Broker {
  const url = /^(mqtts?|wss?):\/\//.test(address) && URL.canParse(address) ? new URL(address) : null;
  const isWeb = url?.protocol.startsWith("ws") ?? false;
  const topic = isWeb ? "" : (url?.pathname.replace(/^\/|\/$/g, "") ?? "");
  if (url === null || url.hostname === "" || address.includes("#") || !/^[\w/-]*$/.test(topic)) {
    throw new PlotwrightError(
      "bad-setting",
      "--mqtt: it must be the address of a broker, such as mqtt://192.168.1.5 or mqtts://user:password@broker.example:8883/studio. The topic at its end has letters, digits, _, - and /. Special characters in user and password are written as %40 for @, and so on.",
    );
  }
  const { protocol, host, username, password, pathname, search } = url;
  return {
    url: `${protocol}//${host}${isWeb ? `${pathname}${search}` : ""}`,
    name: host,
    ...(username === "" ? {} : { username: decodeURIComponent(username) }),
    ...(password === "" ? {} : { password: decodeURIComponent(password) }),
    topic: topic === "" ? DEFAULT_TOPIC : topic,
  };
}

/** `plotting`, `paused` and `waiting` are those of its job; `waiting` is for a pen. */
type ShownState = "absent" | "fault" | "idle" | "moving" | "plotting" | "paused" | "waiting";

export interface PlotterReport {
  readonly name: string;
  readonly state: ShownState;
  /** What is wrong or happening, for people; null if there is nothing to say. */
  readonly message: string | null;
  readonly penUp: boolean | null;
  readonly job: string | null;
  /** Of the job's time, 0 to 100. */
  readonly progressPct: number | null;
  readonly remainingS: number | null;
  /** Jobs that wait in its queue. */
  readonly queued: number;
}

export function reportOf(plotter: Plotter, jobs: readonly Job[]): PlotterReport {
  const own = jobs.filter(({ plotterId }) => plotterId === plotter.id);
  const job = own.find(({ state }) => state === "plotting" || state === "paused");
  return {
    name: plotter.name,
    state: stateOf(plotter, job),
    message: job?.message ?? plotter.message,
    penUp: plotter.penUp,
    job: job?.name ?? null,
    progressPct: job === undefined ? null : Math.floor(1000 * job.progress) / 10,
    remainingS: job === undefined || job.remainingS === null ? null : Math.round(job.remainingS),
    queued: own.filter(({ state }) => state === "queued").length,
  };
}

function stateOf({ connection, activity }: Plotter, job: Job | undefined): ShownState {
  if (job?.state === "plotting") return "plotting";
  if (job?.state === "paused") return job.wait === null ? "paused" : "waiting";
  if (connection === "fault") return "fault";
  if (connection === "absent" || connection === "connecting") return "absent";
  return activity === "moving" ? "moving" : "idle";
}

/** What `<topic>/<plotter>/command` takes. */
export const COMMANDS = ["start", "pause", "resume", "cancel"] as const;
export type MqttCommand = (typeof COMMANDS)[number];

export const statusTopic = ({ topic }: Broker): string => `${topic}/status`;
export const stateTopic = ({ topic }: Broker, id: string): string => `${topic}/${id}/state`;
export const commandTopic = ({ topic }: Broker, id: string): string => `${topic}/${id}/command`;
/** Why a command was refused. */
export const errorTopic = ({ topic }: Broker, id: string): string => `${topic}/${id}/error`;

const LABELS: Readonly<Record<MqttCommand, readonly [name: string, icon: string]>> = {
  start: ["Start next job", "mdi:play"],
  pause: ["Pause", "mdi:pause"],
  resume: ["Resume", "mdi:play-pause"],
  cancel: ["Cancel", "mdi:stop"],
};

/** For Home Assistant, which makes a device of the plotter by itself: what to publish, by topic. */
export function discoveryOf(
  broker: Broker,
  { id, name }: Pick<Plotter, "id" | "name">,
  version: string,
): ReadonlyMap<string, object> {
  const node = `${broker.topic}_${id}`.replace(/\W/g, "_");
  const device = { identifiers: [node], name, manufacturer: "plotwright", sw_version: version };
  const common = { device, availability_topic: statusTopic(broker) };
  const state_topic = stateTopic(broker, id);
  const sensor = (key: keyof PlotterReport, label: string, more: object): [string, object] => [
    `homeassistant/sensor/${node}/${key}/config`,
    {
      ...common,
      name: label,
      unique_id: `${node}_${key}`,
      state_topic,
      // Home Assistant shows the text "None" as unknown.
      value_template: `{{ value_json.${key} }}`,
      ...more,
    },
  ];
  const button = (command: MqttCommand): [string, object] => [
    `homeassistant/button/${node}/${command}/config`,
    {
      ...common,
      name: LABELS[command][0],
      icon: LABELS[command][1],
      unique_id: `${node}_${command}`,
      command_topic: commandTopic(broker, id),
      payload_press: command,
    },
  ];
  return new Map([
    sensor("state", "State", { icon: "mdi:draw-pen", json_attributes_topic: state_topic }),
    sensor("job", "Job", { icon: "mdi:vector-polyline" }),
    sensor("progressPct", "Progress", { unit_of_measurement: "%", state_class: "measurement" }),
    sensor("remainingS", "Remaining time", { unit_of_measurement: "s", device_class: "duration" }),
    sensor("queued", "Queued jobs", { icon: "mdi:tray-full", state_class: "measurement" }),
    ...COMMANDS.map(button),
  ]);
}
