/** How a routes file describes its routes, for the OpenAPI document. */
import type { Router } from "express";
import { z, type ZodType } from "zod";

export interface ApiRoute {
  readonly method: "get" | "post" | "put" | "patch" | "delete";
  /** Below /api/v1, with :names as in express. */
  readonly path: string;
  readonly about: string;
  /** "file": the body is the content of a file. */
  readonly body?: ZodType | "file";
  readonly answer: ZodType | "text" | "events";
  readonly status?: number;
}

/** A router, and the description of each of its routes. */
export interface ApiPart {
  /** Where the router is mounted, below /api/v1. */
  readonly path: string;
  readonly router: Router;
  readonly routes: readonly ApiRoute[];
}

export const okSchema = z.object({ ok: z.literal(true) });

export const route = (
  method: ApiRoute["method"],
  path: string,
  about: string,
  answer: ApiRoute["answer"],
  more: Pick<ApiRoute, "body" | "status"> = {},
): ApiRoute => ({ method, path, about, answer, ...more });
