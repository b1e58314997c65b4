/** /api/v1/samples: the drawings that come with plotwright. */
import { Router } from "express";
import { readFile, readdir } from "node:fs/promises";
import { join } from "node:path";
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import { route, type ApiRoute } from "./api-route.js";

export const SAMPLE_ROUTES: readonly ApiRoute[] = [
  route(
    "get",
    "/samples",
    "Lists the sample drawings",
    z.object({ samples: z.array(z.object({ name: z.string(), title: z.string() })) }),
  ),
  route("get", "/samples/:name", "Returns a sample drawing", "text"),
];

export function sampleRoutes(dir: string): Router {
  const router = Router();
  const names = async (): Promise<string[]> =>
    (await readdir(dir).catch(() => [])).filter((name) => name.endsWith(".svg")).sort();

  router.get("/", async (_request, response) => {
    response.json({ samples: (await names()).map((name) => ({ name, title: titleOf(name) })) });
  });

  // Only names in the listing are opened, so no name can refer to a file outside the folder.
  router.get("/:name", async (request, response) => {
    const { name } = request.params;
    if (!(await names()).includes(name)) {
      throw new PlotwrightError("not-found", `There is no sample ${name}.`);
    }
    response.type("text/plain; charset=utf-8").send(await readFile(join(dir, name), "utf8"));
  });
  return router;
}

/** "many-short-strokes.svg" -> "Many short strokes" */
function titleOf(name: string): string {
  const words = name.replace(/\.svg$/, "").replaceAll("-", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}
