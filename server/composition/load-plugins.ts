/** Loads the plug-ins that the server's options ask for. Others are not imported. */
import { type PluginCore, type ServerPlugin, claimsWithoutSharing } from "../plugins/server-plugin.js";
import type { JobHooks } from "../../host/queue/queue-parts.js";
import type { ServerOptions } from "./server-options.js";

/** The webhooks are first, so that their deliveries are closed even if a later plug-in fails to start. */
export async function loadPlugins(options: ServerOptions, core: PluginCore): Promise<ServerPlugin[]> {
  const { webhooks = true, watchDir, sharedQueue, mqtt, lan = false, mdns = lan } = options;
  const plugins: ServerPlugin[] = [];
  if (webhooks) {
    const { webhooksPlugin } = await import("../plugins/webhooks/plugin.js");
    plugins.push(webhooksPlugin(core));
  }
  const { cameraPlugin } = await import("../plugins/camera/plugin.js");
  plugins.push(cameraPlugin(core));
  if (watchDir !== undefined) {
    const { watchFolderPlugin } = await import("../plugins/watch-folder/plugin.js");
    plugins.push(watchFolderPlugin(watchDir));
  }
  if (sharedQueue !== undefined) {
    const { sharedQueuePlugin } = await import("../plugins/shared-queue/plugin.js");
    const { sharedPollMs: pollMs, sharedLostAfterMs: lostAfterMs, sharedTimeoutMs: timeoutMs } = options;
    plugins.push(sharedQueuePlugin({ url: sharedQueue, pollMs, lostAfterMs, timeoutMs }, core));
  }
  if (mqtt !== undefined) {
    const { mqttPlugin } = await import("../plugins/mqtt/plugin.js");
    plugins.push(mqttPlugin(mqtt));
  }
  if (mdns) {
    const { localNamePlugin } = await import("../plugins/local-name/plugin.js");
    plugins.push(localNamePlugin());
  }
  return plugins;
}

/** Combines the hooks of all plug-ins for the queue. At most one plug-in makes claims. */
export function jobHooksOf(plugins: readonly ServerPlugin[], { store }: PluginCore): Required<JobHooks> {
  const hooks = plugins.flatMap(({ jobs }) => jobs ?? []);
  return {
    withChange: (before, after) => hooks.forEach((hook) => hook.withChange?.(before, after)),
    afterChange: () => hooks.forEach((hook) => hook.afterChange?.()),
    onRemoved: (jobId) => hooks.forEach((hook) => hook.onRemoved?.(jobId)),
    onProgress: (job) => hooks.forEach((hook) => hook.onProgress?.(job)),
    claims: hooks.find(({ claims }) => claims !== undefined)?.claims ?? claimsWithoutSharing(store),
  };
}
