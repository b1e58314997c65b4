import type { ZodType } from "zod";

export interface ApiRoute {
  readonly method: "get" | "post" | "put" | "patch" | "delete";
  /** Below /api/v1, with :names as in express. */
  readonly path: string;
  readonly about: string;
  readonly body?: ZodType;
  readonly answer: ZodType | "text" | "events";
  readonly status?: number;
}
