/** /api/v1/machines: machine profiles, both built-in and custom. */
import express, { Router } from "express";
import { PlotwrightError } from "../../src/index.js";
import { machineListSchema, machineProfileSchema } from "../../src/schema/index.js";
import type { MachineFiles } from "../storage/machine-files.js";
import { okSchema, route, type ApiRoute } from "./api-route.js";
import { parseWith } from "../../host/parse-with.js";

export const MACHINE_ROUTES: readonly ApiRoute[] = [
  route("get", "/machines", "Lists the machine profiles", machineListSchema),
  route("put", "/machines/:id", "Stores a custom machine profile", machineProfileSchema, {
    body: machineProfileSchema,
  }),
  route("delete", "/machines/:id", "Removes a custom machine profile", okSchema),
];

export function machineRoutes(machines: MachineFiles): Router {
  const router = Router();
  router.use(express.json({ limit: "100kb" }));

  router.get("/", (_request, response) => {
    response.json({ machines: machines.list() });
  });

  router.put("/:id", (request, response) => {
    const machine = parseWith(machineProfileSchema, request.body);
    if (machine.id !== request.params.id) {
      throw new PlotwrightError(
        "bad-setting",
        `id: it is ${machine.id} in the profile, but ${request.params.id} in the path.`,
      );
    }
    response.json(machines.save(machine));
  });

  router.delete("/:id", (request, response) => {
    machines.remove(request.params.id);
    response.json({ ok: true });
  });

  return router;
}
