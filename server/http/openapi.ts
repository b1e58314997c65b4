/** The API as an OpenAPI 3.1 document, generated from the table of operations. */
import { z, type ZodType } from "zod";
import * as schemaEntry from "../../src/schema/index.js";
import {
  API_PATH,
  apiErrorSchema,
  liveReportSchema,
  PICTURE_TYPES,
  maySubmitterPerform,
  serverEventSchema,
  type Operation,
  type OperationTable,
  type Role,
} from "../../src/schema/index.js";
import { SESSION_COOKIE } from "./auth.js";

type Io = "input" | "output";
interface JsonSchema {
  readonly [key: string]: unknown;
  readonly properties?: Readonly<Record<string, JsonSchema>>;
}

/**
 * The document as JSON. It is generated operation by operation with pauses: this thread also streams to the board,
 * and generating everything in one go would take so long that a running plot would underrun.
 */
export async function openApiText(version: string, table: Partial<OperationTable>): Promise<string> {
  const components = new Components();
  const paths: Record<string, Record<string, object>> = {};
  for (const [group, operations] of Object.entries(table)) {
    for (const [name, one] of Object.entries(operations ?? {})) {
      const path = one.path.replace(/:(\w+)/g, "{$1}");
      const described = { operationId: idOf(group, name), tags: [group], ...describe(one, components) };
      paths[path] = { ...paths[path], [one.method]: described };
      await new Promise((resolve) => setImmediate(resolve));
    }
  }
  const error = {
    description: "The error, with a message for people",
    content: components.json(apiErrorSchema),
  };
  return components.textOf((schemas) => ({
    openapi: "3.1.0",
    info: {
      title: "plotwright",
      version,
      description:
        "Pen plotters: their queue, their plots and moves by hand. docs/api.md explains how the parts work together.",
      license: { name: "MIT", identifier: "MIT" },
    },
    // With "/" here and the whole path below, clients that join the two would ask for //api.
    servers: [{ url: API_PATH }],
    // The last: programs on the server's computer need neither.
    security: [{ key: [] }, { session: [] }, {}],
    tags: Object.keys(table).map((name) => ({ name })),
    paths,
    components: {
      securitySchemes: {
        key: { type: "http", scheme: "bearer", description: "An access key, made with POST /access/keys" },
        session: { type: "apiKey", in: "cookie", name: SESSION_COOKIE, description: "A paired browser" },
      },
      responses: { Error: error },
      schemas,
    },
  }));
}

/** "jobs" and "emergency-stop": jobsEmergencyStop. */
const idOf = (group: string, name: string): string =>
  `${group}-${name}`.replace(/-(\w)/g, (_all, letter: string) => letter.toUpperCase());

function describe(one: Operation, components: Components): object {
  const parameters = [
    ...[...one.path.matchAll(/:(\w+)/g)].map(([, name]) => ({
      name,
      in: "path",
      required: true,
      schema: { type: "string" },
    })),
    ...components.query(one.query ?? one.fileFields),
  ];
  return {
    summary: one.about,
    description: `Roles: ${rolesOf(one)}.`,
    ...(parameters.length === 0 ? {} : { parameters }),
    ...(one.body === undefined ? {} : { requestBody: requestBody(one, one.body, components) }),
    responses: {
      [one.status]: { description: one.about, content: answerContent(one.answer, components) },
      default: { $ref: "#/components/responses/Error" },
    },
  };
}

function rolesOf(one: Operation): string {
  const { role } = one;
  if (role === "local") return "only the server's own computer";
  const isForWatchers = role === "all" || role === "watch" || role === "stop";
  const roles: readonly Role[] = [
    "operate",
    ...(maySubmitterPerform(one) ? (["submit"] as const) : []),
    ...(isForWatchers ? (["watch"] as const) : []),
  ];
  return roles.join(", ");
}

/** The fields of a query or a form. */
const fieldsOf = (type: ZodType): Readonly<Record<string, JsonSchema>> =>
  (z.toJSONSchema(type, { io: "input", unrepresentable: "any" }) as JsonSchema).properties ?? {};

const BINARY = { "application/octet-stream": {} };

function requestBody(
  { fileFields, isBodyOptional }: Operation,
  body: NonNullable<Operation["body"]>,
  components: Components,
): object {
  if (body === "file") return { required: true, content: BINARY };
  return {
    required: isBodyOptional !== true,
    content: {
      ...components.json(body, "input"),
      ...(fileFields && {
        ...BINARY,
        "multipart/form-data": {
          schema: {
            type: "object",
            properties: { ...fieldsOf(fileFields), drawing: { type: "string", format: "binary" } },
            required: ["drawing"],
          },
        },
      }),
    },
  };
}

function answerContent(answer: Operation["answer"], components: Components): object {
  if (answer === "text" || answer === "file") return { "text/plain": { schema: { type: "string" } } };
  if (answer === "picture") return Object.fromEntries(Object.values(PICTURE_TYPES).map((type) => [type, {}]));
  if (answer === "events") return { "text/event-stream": { schema: components.schemaOf(serverEventSchema) } };
  if (answer === "socket") return components.json(liveReportSchema);
  return components.json(answer);
}

/** The names of the schemas, such as Job for jobSchema. */
export function schemaNames() {
  const names = z.registry<{ id: string }>();
  for (const [name, one] of Object.entries(schemaEntry)) {
    if (!(one instanceof z.ZodType) || !name.endsWith("Schema")) continue;
    names.add(one, { id: name.charAt(0).toUpperCase() + name.slice(1, -"Schema".length) });
  }
  return names;
}

/**
 * The schemas that have a name are described once; those that are both sent and returned twice, since fields with a
 * default may be left out when they are sent.
 */
class Components {
  private readonly names = schemaNames();
  private readonly schemas: Readonly<Record<Io, Map<string, JsonSchema>>> = {
    input: new Map(),
    output: new Map(),
  };

  json(type: ZodType, io: Io = "output"): object {
    return { "application/json": { schema: this.schemaOf(type, io) } };
  }

  query(type: ZodType | undefined): object[] {
    if (type === undefined) return [];
    return Object.entries(fieldsOf(type)).map(([name, schema]) => ({ name, in: "query", schema }));
  }

  schemaOf(type: ZodType, io: Io = "output"): JsonSchema {
    const { $defs = {}, ...schema } = z.toJSONSchema(type, {
      io,
      unrepresentable: "any",
      metadata: this.names,
      override: ({ jsonSchema }) => shorten(jsonSchema, io),
    });
    for (const [name, definition] of Object.entries($defs)) {
      this.schemas[io].set(name, withRefs(definition, io));
    }
    return withRefs(schema, io);
  }

  /** `document` refers to the schemas of this object, all of which are known by now. */
  textOf(document: (schemas: object) => object): string {
    const { input, output } = this.schemas;
    const sent = [...input].map(([name, schema]) => [`${name}${SENT}`, schema] as const);
    const text = JSON.stringify(document(Object.fromEntries([...output, ...sent])));
    return [...input.keys()].reduce(
      (now, name) =>
        now
          .replaceAll(`${REF}${name}${SENT}"`, `${REF}${name}${output.has(name) ? "Input" : ""}"`)
          .replaceAll(`"${name}${SENT}":`, `"${name}${output.has(name) ? "Input" : ""}":`),
      text,
    );
  }
}

const REF = "#/components/schemas/";
/** Marks the name of a schema that is sent, until it is known which are returned too. */
const SENT = "~sent";

const withRefs = (schema: object, io: Io): JsonSchema => {
  const end = io === "input" ? SENT : "";
  const text = JSON.stringify(schema).replaceAll(/"#\/\$defs\/([^"]+)"/g, `"${REF}$1${end}"`);
  return { ...(JSON.parse(text) as JsonSchema), $schema: undefined, id: undefined };
};

/** Without what says nothing: the limits of whole numbers in JavaScript, and that an answer has no further fields. */
function shorten(schema: z.core.JSONSchema.BaseSchema, io: Io): void {
  if (schema.minimum === Number.MIN_SAFE_INTEGER) delete schema.minimum;
  if (schema.maximum === Number.MAX_SAFE_INTEGER) delete schema.maximum;
  if (io === "output" && schema.additionalProperties === false) delete schema.additionalProperties;
}
