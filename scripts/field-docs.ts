/** The docstrings of the fields of the schemas, for the HTTP reference: schemas have none when the program runs. */
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import ts from "typescript-6";

/** By type and path: "Job.stats" for the field `stats` of `jobSchema`. */
export function fieldDocs(folder: string): ReadonlyMap<string, string> {
  const docs = new Map<string, string>();
  for (const file of readdirSync(folder).filter((name) => name.endsWith(".ts"))) {
    const text = readFileSync(path.join(folder, file), "utf8");
    const source = ts.createSourceFile(file, text, ts.ScriptTarget.Latest, true);
    const values = valuesIn(source);
    for (const [name, value] of values) {
      if (name.endsWith("Schema")) addDocs(value, typeName(name), values, docs);
    }
  }
  return docs;
}

type Values = ReadonlyMap<string, ts.Expression>;

const typeName = (name: string): string => name.charAt(0).toUpperCase() + name.slice(1, -"Schema".length);

/** The constants at the top of a file. */
function valuesIn(source: ts.SourceFile): Values {
  const declared = source.statements
    .filter(ts.isVariableStatement)
    .flatMap((one) => [...one.declarationList.declarations]);
  return new Map(
    declared.flatMap(({ name, initializer }): [string, ts.Expression][] =>
      ts.isIdentifier(name) && initializer ? [[name.text, initializer]] : [],
    ),
  );
}

/** Adds the docs of all fields below `node`, which is at `at`. Follows `...shape` and `baseSchema.extend(…)`. */
function addDocs(node: ts.Node, at: string, values: Values, docs: Map<string, string>): void {
  if (ts.isPropertyAssignment(node)) {
    const place = `${at}.${node.name.getText()}`;
    const doc = docOf(node);
    if (doc !== "") docs.set(place, doc);
    addDocs(node.initializer, place, values, docs);
    return;
  }
  const base = ts.isSpreadAssignment(node) || ts.isPropertyAccessExpression(node) ? node.expression : null;
  const value = base && ts.isIdentifier(base) ? values.get(base.text) : undefined;
  if (value) addDocs(value, at, values, docs);
  ts.forEachChild(node, (child) => addDocs(child, at, values, docs));
}

/** On one line, without the full stop at its end. */
function docOf(node: ts.Node): string {
  const comments = ts.getJSDocCommentsAndTags(node).filter(ts.isJSDoc);
  const text = comments.map(({ comment }) => ts.getTextOfJSDocComment(comment) ?? "").join(" ");
  return text.replace(/\s+/g, " ").trim().replace(/\.$/, "");
}
