/** Performs operations of the table: checks what was sent, then calls the handler. */
import { handlerArguments, type Operation, type OperationInput } from "../../src/schema/index.js";
import { parseWith } from "../parse-with.js";

/** Throws `bad-setting` that names the first invalid field. */
export async function performOperation(
  operation: Operation,
  handler: (...args: never[]) => unknown,
  { id, sent }: OperationInput,
  context: unknown,
): Promise<unknown> {
  const { body, query, isBodyOptional } = operation;
  const schema = query ?? (body === "file" ? undefined : body);
  const given = isBodyOptional === true ? (sent ?? {}) : sent;
  const checked = schema === undefined ? given : parseWith(schema, given);
  const args = [...handlerArguments(operation, { id, sent: checked }), context];
  const answer = await (handler as (...all: unknown[]) => unknown)(...args);
  return answer === undefined ? { ok: true } : answer;
}
