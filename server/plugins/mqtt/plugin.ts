/** The plug-in that reports the plotters to an MQTT broker, and takes commands from it. */
import { PlotwrightError } from "../../../src/index.js";
import type { ServerPlugin } from "../server-plugin.js";
import { MqttBridge } from "./mqtt-bridge.js";
import { brokerAt } from "./broker.js";

export function mqttPlugin(address: string): ServerPlugin {
  const broker = brokerAt(address);
  return {
    name: "the MQTT broker",
    start: async (host) => {
      const bridge = new MqttBridge(await mqtt(), broker, host);
      return { onEvent: () => bridge.changed(), close: () => bridge.close() };
    },
  };
}

/** The package is not installed with plotwright: it is larger than all that most users need. */
async function mqtt(): Promise<typeof import("mqtt")> {
  try {
    return await import("mqtt");
  } catch (cause) {
    if ((cause as NodeJS.ErrnoException).code !== "ERR_MODULE_NOT_FOUND") throw cause;
    throw new PlotwrightError(
      "bad-setting",
      "--mqtt needs the package mqtt. Install it beside plotwright: npm install mqtt, or npm install -g mqtt if plotwright is installed with -g.",
      { cause },
    );
  }
}
