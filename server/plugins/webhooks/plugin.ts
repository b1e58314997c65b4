/** The plug-in that notifies other programs of jobs: started, progress, waiting, done, failed. */
import type { ServerHandlers } from "../../http/operation-routes.js";
import type { PluginCore, ServerPlugin } from "../server-plugin.js";
import { WebhookStore } from "./webhook-store.js";
import { Webhooks } from "./webhooks.js";

export function webhooksPlugin({ store, plotters, log }: PluginCore): ServerPlugin {
  const webhooks = new Webhooks({
    store: new WebhookStore(store.database),
    plotterName: (id) => plotters.get(id)?.snapshot().name ?? id,
    log,
  });
  return {
    name: "the webhooks",
    jobs: {
      withChange: (before, after) => webhooks.note(before, after),
      afterChange: () => webhooks.wake(),
      onProgress: (job) => webhooks.progressed(job),
    },
    start: () => {
      webhooks.start();
      return {
        operations: { webhooks: webhookOperations(webhooks, log) },
        close: () => webhooks.close(),
      };
    },
  };
}

export const webhookOperations = (webhooks: Webhooks, log: (line: string) => void) =>
  ({
    list: () => ({ webhooks: webhooks.list() }),
    add: (wanted) => {
      const added = webhooks.add(wanted);
      log(`webhook ${JSON.stringify(added.webhook.name)} added (${new URL(added.webhook.url).host})`);
      return added;
    },
    remove: (id) => webhooks.remove(id),
  }) satisfies ServerHandlers["webhooks"];
