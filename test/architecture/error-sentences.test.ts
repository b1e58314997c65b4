/** The messages of errors are sentences: a capital or a name at the beginning, and a stop at the end. */
import ts from "typescript-6";
import { describe, expect, it } from "vitest";
import { sourcesIn } from "./checks.js";

/** A name of a call or a setting, such as `openPlotter: …` or `liftAfterMs is …`, is written as it is. */
const NAME = /^[a-z]+([A-Z]\w*|:)/;
const BEGINS = /^[^a-z]/;
const ENDS = /[.!?][)”"]?$/;

/** Every text that an expression may begin or end with; none where it depends on other code. */
function textsOf(message: ts.Expression, at: "begin" | "end"): string[] {
  if (ts.isStringLiteralLike(message)) return message.text === "" ? [] : [message.text];
  if (ts.isParenthesizedExpression(message)) return textsOf(message.expression, at);
  if (ts.isConditionalExpression(message)) {
    return [message.whenTrue, message.whenFalse].flatMap((one) => textsOf(one, at));
  }
  if (ts.isBinaryExpression(message)) {
    if (message.operatorToken.kind !== ts.SyntaxKind.PlusToken) return textsOf(message.right, at);
    return textsOf(at === "begin" ? message.left : message.right, at);
  }
  if (!ts.isTemplateExpression(message)) return [];
  const last = message.templateSpans[message.templateSpans.length - 1];
  const [own, inserted] =
    at === "begin"
      ? [message.head.text, message.templateSpans[0].expression]
      : [last.literal.text, last.expression];
  return own === "" ? textsOf(inserted, at) : [own];
}

/** Which argument of a function becomes an error's message, or only its beginning. */
interface Maker {
  readonly argument: number;
  readonly isWhole: boolean;
}

const isError = (node: ts.Node): node is ts.NewExpression =>
  ts.isNewExpression(node) && node.expression.getText() === "PlotwrightError";

const messageOf = (node: ts.NewExpression): ts.Expression | undefined => node.arguments?.[1];

/** Begins with a name, as in `${option}: …`. */
const isName = ({ templateSpans }: ts.TemplateExpression): boolean =>
  templateSpans[0].literal.text.startsWith(":");

/** The functions of a file that make an error from a message, by their names. */
function makersIn(file: ts.SourceFile): ReadonlyMap<string, Maker> {
  const makers = new Map<string, Maker>();
  const visit = (node: ts.Node, inside: ts.SignatureDeclaration | null): void => {
    const within = ts.isFunctionLike(node) ? node : inside;
    const message = isError(node) ? messageOf(node) : undefined;
    if (message && within) {
      const isBegun = ts.isTemplateExpression(message) && message.head.text === "" && !isName(message);
      const first = isBegun ? message.templateSpans[0].expression : message;
      const argument = within.parameters.findIndex(({ name }) => name.getText() === first.getText());
      const name = within.name ?? (ts.isVariableDeclaration(within.parent) ? within.parent.name : null);
      if (name && argument >= 0) makers.set(name.getText(), { argument, isWhole: !isBegun });
    }
    ts.forEachChild(node, (child) => visit(child, within));
  };
  visit(file, null);
  return makers;
}

/** The beginnings and ends of messages that are not those of a sentence, with their files. */
function brokenSentences(name: string, text: string): string[] {
  const file = ts.createSourceFile(name, text, ts.ScriptTarget.ES2022, true);
  const makers = makersIn(file);
  const broken: string[] = [];
  const check = (message: ts.Expression | undefined, isWhole: boolean): void => {
    if (!message) return;
    const begins = textsOf(message, "begin").filter((one) => !BEGINS.test(one) && !NAME.test(one));
    const ends = isWhole ? textsOf(message, "end").filter((one) => !ENDS.test(one.trimEnd())) : [];
    broken.push(...[...begins, ...ends].map((one) => `${name}: ${one}`));
  };
  const visit = (node: ts.Node): void => {
    if (isError(node)) check(messageOf(node), true);
    const maker = ts.isCallExpression(node) ? makers.get(node.expression.getText()) : undefined;
    if (maker && ts.isCallExpression(node)) check(node.arguments[maker.argument], maker.isWhole);
    ts.forEachChild(node, visit);
  };
  visit(file);
  return broken;
}

describe("the messages of errors", () => {
  it("are sentences", () => {
    const sources = Object.entries(sourcesIn("src", "host", "server", "web"));
    expect(sources.flatMap(([name, text]) => brokenSentences(name, text))).toEqual([]);
  });

  it.each([
    ["a small letter", 'new PlotwrightError("busy", "the plotter is busy.")'],
    ["no stop", 'new PlotwrightError("busy", `The plotter ${name} is busy`)'],
    ["one of two without a stop", 'new PlotwrightError("busy", isBusy ? "It is busy" : "It is gone.")'],
    [
      "a function that makes the error",
      'const bad = (why: string) => new PlotwrightError("busy", why); bad(`shaper ${name} is missing.`)',
    ],
    [
      "a function that adds to the message",
      'function bad(why: string) { throw new PlotwrightError("busy", `${why} Wait.`); } bad("it is busy.")',
    ],
  ])("are checked: %s is found", (_, text) => {
    expect(brokenSentences("bad.ts", text)).toHaveLength(1);
  });

  it.each([
    'new PlotwrightError("busy", "The plotter is busy.")',
    'new PlotwrightError("busy", `${name} is busy.`)',
    'new PlotwrightError("bad-setting", "openPlotter: give a device.")',
    'new PlotwrightError("bad-setting", `liftAfterMs is ${ms}: give a time.`)',
  ])("may be %s", (text) => {
    expect(brokenSentences("good.ts", text)).toEqual([]);
  });
});
