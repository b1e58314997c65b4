/** What an operation of the table in operations.ts is, and the types of its clients and handlers. */
import { z, type ZodType } from "zod";

/**
 * Who may perform an operation. Who may only submit jobs is refused any other job than its own, as if there were none:
 * that concerns all paths that begin with JOB_PATH.
 */
export type OperationRole =
  /** Everybody with access: it changes nothing and shows no secrets. */
  | "all"
  /** Operators and watchers: it shows the jobs of all. */
  | "watch"
  /** As "watch", although it changes something: the person closest to the plotter must be able to stop it. */
  | "stop"
  /** Operators, and those who submit jobs. */
  | "submit"
  | "operate"
  /** Only users at the computer where the server runs. */
  | "local";

/** The beginning of the paths of operations on one job. */
export const JOB_PATH = "/jobs/:id";

/** Whether the role "submit" may perform an operation. Of stops only those of its own jobs. */
export const maySubmitterPerform = ({ role, path }: Operation): boolean =>
  role === "all" || role === "submit" || (role === "stop" && path.startsWith(JOB_PATH));

export interface Operation {
  readonly method: "get" | "post" | "put" | "patch" | "delete";
  /** Below /api/v1, with at most one :name. */
  readonly path: string;
  /** For the OpenAPI document and docs/http-reference.md. */
  readonly about: string;
  /** "file": the content of a drawing; "picture": that of a picture; "text": plain text; "socket": a WebSocket. */
  readonly answer: ZodType | "text" | "file" | "picture" | "events" | "socket";
  readonly status: 200 | 201;
  readonly role: OperationRole;
  readonly body?: ZodType | "file";
  /** Without a body: all fields are left out. */
  readonly isBodyOptional?: boolean;
  readonly maxBodyBytes: number;
  readonly query?: ZodType;
  /** In place of the body, the file itself is taken, with these fields in the query; or a form with it and these fields. */
  readonly fileFields?: ZodType;
  /** Name under which a browser saves the answer. */
  readonly attachment?: string;
}

type Details = Pick<Operation, "body" | "isBodyOptional" | "query" | "fileFields" | "attachment"> &
  Partial<Pick<Operation, "status" | "role" | "maxBodyBytes">>;

const MAX_BODY_BYTES = 10_240;

/** An operation whose exact path and schemas the types of its clients and handlers need. */
type Row<Path, Answer, More> = Omit<Operation, "path" | "answer" | "body" | "query"> & {
  readonly path: Path;
  readonly answer: Answer;
} & Pick<More, Extract<keyof More, "body" | "query">>;

/** A row of the table. Default: only operators may change something. */
export const operation = <
  const Path extends string,
  Answer extends Operation["answer"],
  const More extends Details = object,
>(
  method: Operation["method"],
  path: Path,
  about: string,
  answer: Answer,
  more?: More,
): Row<Path, Answer, More> =>
  ({
    method,
    path,
    about,
    answer,
    status: 200,
    role: method === "get" ? "all" : "operate",
    maxBodyBytes: MAX_BODY_BYTES,
    ...more,
  }) as unknown as Row<Path, Answer, More>;

/** The answer of operations that return no data. */
export const okSchema = z.object({ ok: z.literal(true) });

/** The text of a drawing, or its bytes. */
export type FileContent = string | ArrayBuffer;

/** What is sent with an operation: its id in the path, and its body or query. */
export interface OperationInput {
  readonly id?: string | undefined;
  readonly sent?: unknown;
}

type IdOf<One> = One extends { readonly path: `${string}:${string}` } ? [id: string] : [];
type SentOf<One, Side extends "input" | "output"> = One extends { readonly body: infer Body }
  ? [body: Body extends ZodType ? SideOf<Body, Side> : FileContent]
  : One extends { readonly query: infer Query extends ZodType }
    ? [query: SideOf<Query, Side>]
    : [];
type SideOf<Type extends ZodType, Side> = Side extends "input" ? z.input<Type> : z.output<Type>;

type AnswerOf<One> = One extends { readonly answer: infer Answer }
  ? Answer extends ZodType
    ? z.output<Answer>
    : Answer extends "file"
      ? FileContent
      : Answer extends "picture"
        ? ArrayBuffer
        : string
  : never;

/** Calls an operation: with the id in its path, then its body or query. */
type Call<One> = (...args: [...IdOf<One>, ...SentOf<One, "input">]) => Promise<AnswerOf<One>>;

/** Performs an operation whose body or query has been checked. `ok` need not be returned. */
type Handler<One, Context> = (
  ...args: [...IdOf<One>, ...SentOf<One, "output">, context: Context]
) => Returned<AnswerOf<One>> | Promise<Returned<AnswerOf<One>>>;
type Returned<Answer> = Answer extends { readonly ok: true } ? void : Answer;

/** Operations by group and name. */
export type OperationTable = Readonly<Record<string, Readonly<Record<string, Operation>>>>;

export type ClientOf<Table> = {
  readonly [Group in keyof Table]: { readonly [Name in keyof Table[Group]]: Call<Table[Group][Name]> };
};

/** `Context`: what else a handler gets about a call. */
export type HandlersOf<Table, Context> = {
  readonly [Group in keyof Table]?: {
    readonly [Name in keyof Table[Group]]?: Handler<Table[Group][Name], Context>;
  };
};

const hasId = ({ path }: Operation): boolean => path.includes(":");
const mapped = <In, Out>(record: Readonly<Record<string, In>>, map: (value: In, key: string) => Out) =>
  Object.fromEntries(Object.entries(record).map(([key, value]) => [key, map(value, key)]));

/** The client of a transport. `send`: sends one call, and returns the answer. */
export const clientOf = <Table extends OperationTable>(
  table: Table,
  send: (one: Operation, input: OperationInput, group: string, name: string) => Promise<unknown>,
): ClientOf<Table> =>
  mapped(table, (group, groupName) =>
    mapped(group, (one, name) => (...args: readonly unknown[]) => {
      const input = hasId(one) ? { id: String(args[0]), sent: args[1] } : { sent: args[0] };
      return send(one, input, groupName, name);
    }),
  ) as unknown as ClientOf<Table>;

/** Where the operations are on a server. */
export const API_PATH = "/api/v1";

export interface OperationRequest {
  readonly method: string;
  /** From the server's root, with id and query. */
  readonly path: string;
  readonly headers: Readonly<Record<string, string>>;
  readonly body?: string | FileContent;
}

/** The HTTP request of an operation. A file is sent unchanged, any other body as JSON. */
export const requestOf = (one: Operation, input: OperationInput): OperationRequest => {
  const request = { method: one.method.toUpperCase(), path: API_PATH + pathOf(one, input), headers: {} };
  if (one.body === undefined || input.sent === undefined) return request;
  if (one.body === "file") return { ...request, body: input.sent as FileContent };
  return { ...request, body: JSON.stringify(input.sent), headers: { "content-type": "application/json" } };
};

const pathOf = ({ path, query }: Operation, { id = "", sent }: OperationInput): string => {
  const full = path.replace(/:\w+/, encodeURIComponent(id));
  if (query === undefined || sent === undefined) return full;
  const fields = Object.entries(sent as Record<string, unknown>).filter(([, value]) => value !== undefined);
  return `${full}?${fields.map(([key, value]) => `${key}=${encodeURIComponent(String(value))}`).join("&")}`;
};

/** The arguments of a handler. `input.sent` has been checked. */
export const handlerArguments = (one: Operation, { id, sent }: OperationInput): unknown[] => [
  ...(hasId(one) ? [id] : []),
  ...(one.body === undefined && one.query === undefined ? [] : [sent]),
];
