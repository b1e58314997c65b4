/** The API as an OpenAPI 3.1 document, generated from the table of operations. */
import { z, type ZodType } from "zod";
import { API_PATH, apiErrorSchema, serverEventSchema, type Operation } from "../../src/schema/index.js";

/**
 * The document as JSON. It is generated operation by operation with pauses: this thread also streams to the board,
 * and generating everything in one go would take so long that a running plot would underrun.
 */
export async function openApiText(version: string, operations: readonly Operation[]): Promise<string> {
  const paths: Record<string, Record<string, object>> = {};
  for (const one of operations) {
    const path = `${API_PATH}${one.path.replace(/:(\w+)/g, "{$1}")}`;
    paths[path] = { ...paths[path], [one.method]: described(one) };
    await new Promise((resolve) => setImmediate(resolve));
  }
  return JSON.stringify({ openapi: "3.1.0", info: { title: "plotwright", version }, paths });
}

function described({ path, about, body, answer, status }: Operation): object {
  const names = [...path.matchAll(/:(\w+)/g)].map((match) => match[1]);
  return {
    summary: about,
    ...(names.length === 0
      ? {}
      : {
          parameters: names.map((name) => ({ name, in: "path", required: true, schema: { type: "string" } })),
        }),
    ...(body === undefined
      ? {}
      : {
          requestBody: {
            required: true,
            content:
              body === "file"
                ? { "application/octet-stream": {} }
                : { "application/json": { schema: jsonSchema(body, "input") } },
          },
        }),
    responses: {
      [status]: { description: about, content: contentOf(answer) },
      default: {
        description: "The error",
        content: { "application/json": { schema: jsonSchema(apiErrorSchema, "output") } },
      },
    },
  };
}

function contentOf(answer: Operation["answer"]): object {
  if (answer === "text" || answer === "file") return { "text/plain": { schema: { type: "string" } } };
  if (answer === "events")
    return { "text/event-stream": { schema: jsonSchema(serverEventSchema, "output") } };
  return { "application/json": { schema: jsonSchema(answer, "output") } };
}

const jsonSchema = (schema: ZodType, io: "input" | "output"): object =>
  z.toJSONSchema(schema, { io, unrepresentable: "any" });
