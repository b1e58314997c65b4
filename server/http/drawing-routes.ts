/** /api/v1/drawings: uploads a drawing for a job that is added in the next request. */
import { Router, type Request } from "express";
import { z } from "zod";
import type { UploadedDrawings } from "../storage/uploaded-drawings.js";
import { route, type ApiRoute } from "./api-route.js";

export const DRAWING_ROUTES: readonly ApiRoute[] = [
  route(
    "post",
    "/drawings",
    "Uploads a drawing, the file as the body; use its id in POST /jobs within ten minutes",
    z.object({ id: z.string() }),
    { body: "file", status: 201 },
  ),
];

export function drawingRoutes(uploads: UploadedDrawings): Router {
  const router = Router();
  router.post("/", async (request, response) => {
    response.status(201).json({ id: await uploads.add(bytesOf(request)) });
  });
  return router;
}

/** Leaves the connection open when reading stops early, so that an error can still be sent. */
export const bytesOf = (request: Request): AsyncIterable<Uint8Array> =>
  request.iterator({ destroyOnReturn: false }) as AsyncIterable<Uint8Array>;
