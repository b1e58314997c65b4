/** The plug-in that notifies other programs of finished, waiting and failed jobs. */
import type { PluginCore, ServerPlugin } from "../server-plugin.js";
import { WEBHOOK_ROUTES, webhookRoutes } from "./webhook-routes.js";
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
    },
    start: () => {
      webhooks.start();
      return {
        routes: { path: "/webhooks", router: webhookRoutes(webhooks, log), routes: WEBHOOK_ROUTES },
        close: () => webhooks.close(),
      };
    },
  };
}
