/** /api/v1/access: sessions and keys, for operators. */
import express, { Router } from "express";
import { z } from "zod";
import { accessEntrySchema, newKeySchema } from "../../src/schema/index.js";
import type { Access } from "../security/access.js";
import { okSchema, route, type ApiRoute } from "./api-route.js";
import { parseWith } from "../../host/parse-with.js";

export const ACCESS_ROUTES: readonly ApiRoute[] = [
  route("get", "/access", "Lists sessions and keys", z.object({ entries: z.array(accessEntrySchema) })),
  route("post", "/access/keys", "Creates a key", z.object({ entry: accessEntrySchema, secret: z.string() }), {
    body: newKeySchema,
    status: 201,
  }),
  route("delete", "/access/:id", "Revokes a session or key", okSchema),
];

export function accessRoutes(access: Access): Router {
  const router = Router();
  router.get("/", (_request, response) => {
    response.json({ entries: access.list() });
  });
  router.post("/keys", express.json({ limit: "10kb" }), (request, response) => {
    const { name, role } = parseWith(newKeySchema, request.body);
    const { entry, secret } = access.createKey(name, role);
    response.status(201).json({ entry, secret });
  });
  router.delete("/:id", (request, response) => {
    access.revoke(request.params.id);
    response.json({ ok: true });
  });
  return router;
}
