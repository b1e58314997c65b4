/** The MQTT plug-in of a whole server, at a real broker. */
import { Aedes, type Client } from "aedes";
import { connectAsync, type MqttClient } from "mqtt";
import { createServer as createTcpServer, type Server } from "node:net";
import type { AddressInfo } from "node:net";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { brokerAt, reportOf } from "../../../../server/plugins/mqtt/broker.js";
import { createServer, type PlotwrightServer } from "../../../../server/index.js";
import { makeJob, makePlotter } from "../../../support/jobs/jobs.js";
import { folderOfTest } from "../../../support/processes/folders.js";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60" fill="none" stroke="#000">${`<path d="M5 5H55V55H5Z"/>`.repeat(10)}</svg>`;
const PASSWORD = "geh:eim@1";

let broker: Aedes;
let tcp: Server;
let listener: MqttClient;
/** What the broker keeps, by topic; what is not retained, in order. */
let kept: Map<string, string>;
let passing: [topic: string, text: string][];
let server: PlotwrightServer | null;
let logged: string[];
let dataDir: string;
let port: number;

beforeEach(async () => {
  dataDir = folderOfTest();
  [kept, passing, logged, server] = [new Map(), [], [], null];
  await openBroker(0);
  listener = await connectAsync(`mqtt://127.0.0.1:${port}`, { username: "u", password: PASSWORD });
  listener.on("message", (topic, payload, { retain }) => {
    const text = payload.toString("utf8");
    if (!retain) passing.push([topic, text]);
    if (text === "") kept.delete(topic);
    else kept.set(topic, text);
  });
  await listener.subscribeAsync("#", { qos: 1 });
});
afterEach(async () => {
  await server?.close();
  await listener.endAsync(true);
  await closeBroker();
});

async function openBroker(wanted: number): Promise<void> {
  broker = await Aedes.createBroker({
    authenticate: (_client: Client, username, password, done) =>
      done(null, username === "u" && password?.toString("utf8") === PASSWORD),
  });
  tcp = createTcpServer(broker.handle);
  await new Promise<void>((resolve) => tcp.listen(wanted, "127.0.0.1", resolve));
  ({ port } = tcp.address() as AddressInfo);
}

async function closeBroker(): Promise<void> {
  await new Promise<void>((resolve) => broker.close(() => resolve()));
  await new Promise((resolve) => tcp.close(resolve));
}

async function open(path = "", password = encodeURIComponent(PASSWORD)): Promise<void> {
  server = await createServer({
    port: 0,
    device: "virtual",
    dataDir,
    mqtt: `mqtt://u:${password}@127.0.0.1:${port}${path}`,
    log: (line) => logged.push(line),
  });
}

async function addJob(): Promise<string> {
  const answer = await fetch(`${server?.url}/api/v1/jobs?name=frame.svg`, { method: "POST", body: SVG });
  return ((await answer.json()) as { id: string }).id;
}

const command = async (text: string, isRetained = false, topic = "plotwright"): Promise<unknown> =>
  listener.publishAsync(`${topic}/${plotterId()}/command`, text, { qos: 1, retain: isRetained });

const plotterId = (): string =>
  [...kept.keys()].map((topic) => /\/(\w+)\/state$/.exec(topic)?.[1]).find((id) => id !== undefined) ?? "";

const report = (topic = "plotwright"): Record<string, unknown> =>
  JSON.parse(kept.get(`${topic}/${plotterId()}/state`) ?? "{}") as Record<string, unknown>;

describe("a server with a broker", () => {
  it("says that it is online, what its plotter does, and that it is offline", async () => {
    await open();
    await expect.poll(() => kept.get("plotwright/status")).toBe("online");
    await expect
      .poll(() => report())
      .toMatchObject({ state: "idle", job: null, queued: 0, progressPct: null });
    await addJob();
    await expect.poll(() => report()).toMatchObject({ queued: 1 });
    await server?.close();
    server = null;
    await expect.poll(() => kept.get("plotwright/status")).toBe("offline");
  });

  it("starts, pauses, resumes and cancels by commands, and reports each", async () => {
    await open();
    await expect.poll(() => report()).toMatchObject({ state: "idle" });
    await addJob();
    await command("start");
    await expect.poll(() => report()).toMatchObject({ state: "plotting", job: "frame.svg", queued: 0 });
    await command("pause");
    await expect.poll(() => report()).toMatchObject({ state: "paused" });
    await command("resume");
    await expect.poll(() => report()).toMatchObject({ state: "plotting" });
    await expect.poll(() => report()["progressPct"]).toBeGreaterThan(0);
    await command("cancel");
    await expect.poll(() => report()).toMatchObject({ state: "idle", job: null });
  });

  it("refuses what is no command, what fits no job, and retained commands, and says why", async () => {
    await open();
    await expect.poll(() => report()).toMatchObject({ state: "idle" });
    const refusals = (): string[] =>
      passing.filter(([topic]) => topic.endsWith("/error")).map(([, text]) => text);
    await command("explode");
    await expect
      .poll(refusals)
      .toEqual(['"explode" is not a command: there is start, pause, resume, cancel']);
    await command("pause");
    await expect.poll(refusals).toHaveLength(2);
    expect(refusals()[1]).toBe("pause: no job is plotting");
    await command("start");
    await expect.poll(refusals).toHaveLength(3);
  });

  it("does not start a job because of a command that the broker has kept", async () => {
    await listener.publishAsync("plotwright/main/command", "start", { qos: 1, retain: true });
    await open();
    await expect.poll(() => report()).toMatchObject({ state: "idle" });
    await expect.poll(() => logged.join("\n")).toContain("a retained command is ignored");
    expect(plotterId()).toBe("main");
  });

  it("is one device in Home Assistant with sensors and buttons that fit its topics", async () => {
    await open("/studio/left");
    await expect
      .poll(() => [...kept.keys()].filter((topic) => topic.startsWith("homeassistant/")))
      .toHaveLength(9);
    const configs = [...kept]
      .filter(([topic]) => topic.startsWith("homeassistant/"))
      .map(([, text]) => JSON.parse(text) as Record<string, unknown>);
    expect(new Set(configs.map(({ unique_id }) => unique_id)).size).toBe(9);
    expect(new Set(configs.map(({ device }) => JSON.stringify(device))).size).toBe(1);
    for (const { availability_topic, state_topic, value_template, command_topic } of configs) {
      expect(availability_topic).toBe("studio/left/status");
      if (command_topic !== undefined) expect(command_topic).toBe(`studio/left/${plotterId()}/command`);
      else {
        expect(kept.has(String(state_topic))).toBe(true);
        const key = /^\{\{ value_json\.(\w+) \}\}$/.exec(String(value_template))?.[1] ?? "";
        expect(report("studio/left")).toHaveProperty(key);
      }
    }
  });

  it("tells Home Assistant again when that has started, and removes a plotter that is removed", async () => {
    await open();
    await expect.poll(() => report()).toMatchObject({ state: "idle" });
    const added = await fetch(`${server?.url}/api/v1/plotters`, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ name: "Second", device: "virtual" }),
    });
    const { id } = (await added.json()) as { id: string };
    const ofSecond = (): string[] =>
      [...kept.keys()].filter((topic) => topic.includes(id) || topic.includes(id.replaceAll("-", "_")));
    await expect.poll(() => ofSecond().length).toBe(10);
    await fetch(`${server?.url}/api/v1/plotters/${id}`, { method: "DELETE" });
    await expect.poll(() => ofSecond()).toEqual([]);
    passing.length = 0;
    await listener.publishAsync("homeassistant/status", "online", { qos: 1 });
    const told = (): string[] => passing.map(([topic]) => topic).filter((topic) => topic.endsWith("/config"));
    await expect.poll(() => told().length).toBe(9);
  });

  it("starts without the broker, connects when it is there, and again after it was away", async () => {
    await listener.endAsync(true);
    await closeBroker();
    await open();
    await expect.poll(() => logged.join("\n")).toContain("ECONNREFUSED");
    expect(logged.filter((line) => line.startsWith("MQTT")).join("\n")).toContain(`127.0.0.1:${port}`);
    await openBroker(port);
    await expect.poll(() => logged.join("\n"), { timeout: 20_000 }).toContain("MQTT: connected");
  }, 40_000);

  it("never logs user or password, right or wrong", async () => {
    await open("", "wrong-secret");
    await expect.poll(() => logged.join("\n")).toMatch(/can't be used: .*[Nn]ot authorized/);
    expect(logged.join("\n")).not.toMatch(/wrong-secret|u:|geh/);
  });
});

describe("the address of a broker", () => {
  it("has user, password and topic, which are not part of the URL that is used", () => {
    expect(brokerAt("mqtts://me%40x:a%3Ab@broker.example:8884/studio/left/")).toEqual({
      url: "mqtts://broker.example:8884",
      name: "broker.example:8884",
      username: "me@x",
      password: "a:b",
      topic: "studio/left",
    });
    expect(brokerAt("mqtt://10.0.0.5")).toEqual({
      url: "mqtt://10.0.0.5",
      name: "10.0.0.5",
      topic: "plotwright",
    });
    expect(brokerAt("wss://broker.example/mqtt")).toMatchObject({
      url: "wss://broker.example/mqtt",
      topic: "plotwright",
    });
  });

  it.each(["broker.example", "http://broker.example", "mqtt://", "mqtt://h/a+b", "mqtt://u:secret@h/#"])(
    "is refused if it is %s, without repeating it",
    (address) => {
      expect(() => brokerAt(address)).toThrow(/must be the address of a broker/);
      try {
        brokerAt(address);
      } catch (error) {
        expect((error as Error).message).not.toContain("secret");
      }
    },
  );
});

describe("the report of a plotter", () => {
  const job = { ...makeJob("1"), plotterId: "main", name: "fern", remainingS: 61.7, progress: 0.12345 };
  const wait = { kind: "pen", layerName: "Sky", penName: null, color: null } as const;

  it.each([
    [{ connection: "absent" }, [], "absent"],
    [{ connection: "fault" }, [], "fault"],
    [{ connection: "idle", activity: "moving" }, [], "moving"],
    [{ connection: "busy" }, [{ ...job, state: "plotting" }], "plotting"],
    [{ connection: "busy" }, [{ ...job, state: "paused", wait: null }], "paused"],
    [{ connection: "busy" }, [{ ...job, state: "paused", wait }], "waiting"],
    [{ connection: "idle" }, [{ ...job, state: "plotting", plotterId: "other" }], "idle"],
  ] as const)("of case %# is right", (plotter, jobs, state) => {
    expect(reportOf(makePlotter("main", plotter), jobs)).toMatchObject({ state });
  });

  it("rounds progress down and time to seconds, so that 100 % means done", () => {
    const almost = { ...job, state: "plotting", progress: 0.99999 } as const;
    expect(reportOf(makePlotter("main", {}), [almost])).toMatchObject({ progressPct: 99.9, remainingS: 62 });
  });
});
