/** The architecture's checks as functions of sources, so that tests can run them on bad ones too. */
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import ts from "typescript-6";

export const ROOT = path.join(import.meta.dirname, "..", "..");

/** Texts by their paths from the project's root, with forward slashes. */
export type Sources = Readonly<Record<string, string>>;

export function sourceFiles(folder: string): string[] {
  return readdirSync(path.join(ROOT, folder), { recursive: true, encoding: "utf8" })
    .map((file) => path.posix.join(folder, file.split(path.sep).join("/")))
    .filter((file) => /\.tsx?$/.test(file) && !file.endsWith(".d.ts"));
}

export const sourcesIn = (...folders: string[]): Sources =>
  Object.fromEntries(
    folders.flatMap(sourceFiles).map((file) => [file, readFileSync(path.join(ROOT, file), "utf8")]),
  );

export interface Import {
  readonly from: string;
  /** A path without its ending, or the bare name of a package. */
  readonly to: string;
}

export const write = ({ from, to }: Import): string => `${from} imports ${to}`;

const targetOf = (from: string, name: string): string =>
  name.startsWith(".") ? path.posix.join(path.posix.dirname(from), name).replace(/\.jsx?$/, "") : name;

/** All imports, of types and `import("…")` too. */
export const importsOf = (sources: Sources): Import[] =>
  Object.entries(sources).flatMap(([from, text]) =>
    ts.preProcessFile(text, true, true).importedFiles.map(({ fileName }) => ({
      from,
      to: targetOf(from, fileName),
    })),
  );

const parsed = (file: string, text: string): ts.SourceFile =>
  ts.createSourceFile(
    file,
    text,
    ts.ScriptTarget.ES2022,
    true,
    file.endsWith("x") ? ts.ScriptKind.TSX : ts.ScriptKind.TS,
  );

/** The imports at the top of the files, without `import("…")`. */
const staticImportsOf = (sources: Sources): Import[] =>
  Object.entries(sources).flatMap(([from, text]) =>
    parsed(from, text).statements.flatMap((statement) => {
      const isImport = ts.isImportDeclaration(statement) || ts.isExportDeclaration(statement);
      const name = isImport ? statement.moduleSpecifier : undefined;
      if (name === undefined || !ts.isStringLiteral(name)) return [];
      return [{ from, to: targetOf(from, name.text) }];
    }),
  );

/** String literals, and the first piece of each template. */
export function literalsOf(file: string, text: string): string[] {
  const found: string[] = [];
  const visit = (node: ts.Node): void => {
    if (ts.isStringLiteralLike(node) || ts.isTemplateHead(node)) found.push(node.text);
    ts.forEachChild(node, visit);
  };
  visit(parsed(file, text));
  return found;
}

/** The literals that match, outside the exempt paths, with their files. */
const literalsLike = (sources: Sources, pattern: RegExp, exempt: readonly string[]): string[] =>
  Object.entries(sources)
    .filter(([file]) => !exempt.some((start) => file.startsWith(start)))
    .flatMap(([file, text]) =>
      literalsOf(file, text)
        .filter((literal) => pattern.test(literal))
        .map((literal) => `${file}: "${literal}"`),
    );

export const EBB_COMMAND =
  /^(EM|SC|SP|S2|SM|XM|LM|LT|L3|T3|TD|TR|HM|ES|QS|QM|QG|QB|QC|QU|QE|QP|QL|SL|CS|CU|PI|PD)(,[\d-]|,$|$)/;

/** A line of G-code, a system command, or the greeting. */
export const GRBL_COMMAND = /^(G\d+([A-Z$]|$)|M[345](S|$)|\$([XHIGC#$]|SLP)$|\$(J|RST)=|Grbl(HAL)?( |$))/;

/** Commands of a controller outside its driver's folder. */
export const foreignCommands = (sources: Sources): string[] => [
  // HPGL has commands of the same names.
  ...literalsLike(sources, EBB_COMMAND, ["src/drivers/ebb/", "src/import/hpgl/"]),
  ...literalsLike(sources, GRBL_COMMAND, ["src/drivers/grbl/"]),
];

/** Kinds of controllers that are named outside their folders and the registry. */
export const foreignKinds = (sources: Sources): string[] =>
  literalsLike(sources, /^(ebb|grbl)$/, [
    "src/drivers/",
    // The plotters that come with plotwright have an EiBotBoard, as have all profiles of format 1.
    "src/machines/profiles.ts",
    "src/schema/machine.ts",
    // The page's form for the fields of an EiBotBoard.
    "web/plotter/machines/profile.ts",
  ]);

/** Private members that are not `private name`. */
export const privateIdentifiers = (sources: Sources): string[] =>
  Object.entries(sources).flatMap(([file, text]) => {
    const found: string[] = [];
    const visit = (node: ts.Node): void => {
      if (ts.isPrivateIdentifier(node)) found.push(`${file}: ${node.text}`);
      ts.forEachChild(node, visit);
    };
    visit(parsed(file, text));
    return found;
  });

const isTypeDeclaration = (
  node: ts.Statement,
): node is ts.InterfaceDeclaration | ts.TypeAliasDeclaration | ts.ClassDeclaration =>
  ts.isInterfaceDeclaration(node) || ts.isTypeAliasDeclaration(node) || ts.isClassDeclaration(node);

/** The files that declare each type at their top level, those that export it first. */
function typesByName(sources: Sources): Map<string, { exporting: string[]; local: string[] }> {
  const types = new Map<string, { exporting: string[]; local: string[] }>();
  for (const [file, text] of Object.entries(sources)) {
    for (const statement of parsed(file, text).statements) {
      if (!isTypeDeclaration(statement) || statement.name === undefined) continue;
      const name = statement.name.text;
      const files = types.get(name) ?? { exporting: [], local: [] };
      const isExported =
        statement.modifiers?.some(({ kind }) => kind === ts.SyntaxKind.ExportKeyword) === true;
      (isExported ? files.exporting : files.local).push(file);
      types.set(name, files);
    }
  }
  return types;
}

/** Names of types that several files export: a reader can't tell which one is meant. */
export const typesExportedTwice = (sources: Sources): string[] =>
  [...typesByName(sources)]
    .filter(([, { exporting }]) => exporting.length > 1)
    .map(([name, { exporting }]) => `${name}: ${exporting.join(", ")}`);

/** Local types that have the name of a type that another file exports. */
export const localTypesNamedLikeExported = (sources: Sources, obvious: readonly string[] = []): string[] =>
  [...typesByName(sources)]
    .filter(
      ([name, { exporting, local }]) => exporting.length > 0 && local.length > 0 && !obvious.includes(name),
    )
    .flatMap(([name, { local }]) => local.map((file) => `${file}: ${name}`));

const driverOf = (file: string): string | undefined => /^src\/drivers\/([^/]+)\//.exec(file)?.[1];

/** A driver that uses another one. */
export const importsBetweenDrivers = (sources: Sources): string[] =>
  importsOf(sources)
    .filter(({ from, to }) => {
      const [own, other] = [driverOf(from), driverOf(to)];
      return own !== undefined && other !== undefined && own !== other;
    })
    .map(write);

const pluginOf = (file: string): string | null => /^server\/plugins\/[^/]+(?=\/)/.exec(file)?.[0] ?? null;

/** Plug-ins that are loaded although no option asks for them. */
export const staticPluginImports = (sources: Sources): string[] =>
  staticImportsOf(sources)
    .filter(({ from, to }) => pluginOf(to) !== null && pluginOf(from) !== pluginOf(to))
    .map(write);

/** The parts of `planJob`, and who may use them. The entries of src may pass them on. */
const PARTS_OF_PLANNING: Readonly<Record<string, readonly string[]>> = {
  // A stop brakes with the speeds of the layer; the page and the export show them.
  withLayerCodes: [
    "src/job/plan-job.ts",
    "src/drivers/ebb/machine/braking.ts",
    "src/export/coded-names.ts",
    "web/layers/layer-details.tsx",
  ],
  plannerOf: ["src/job/plan-job.ts"],
  plan: ["src/drivers/"],
  motionForFirmware: ["src/drivers/ebb/"],
  planEbbJob: ["src/drivers/ebb/"],
  compile: ["src/drivers/ebb/"],
  planGrblJob: ["src/drivers/grbl/"],
};
const ENTRIES = ["src/index.ts", "src/internal.ts"];

/** The names that a file imports, or passes on, from src. */
const namesFromSrc = (file: string, text: string): string[] =>
  parsed(file, text).statements.flatMap((statement) => {
    const isImport = ts.isImportDeclaration(statement);
    if (!isImport && !ts.isExportDeclaration(statement)) return [];
    const from = statement.moduleSpecifier;
    if (from === undefined || !ts.isStringLiteral(from)) return [];
    if (!targetOf(file, from.text).startsWith("src/")) return [];
    const names = isImport ? statement.importClause?.namedBindings : statement.exportClause;
    if (names === undefined || !("elements" in names)) return [];
    return names.elements.map((one) => (one.propertyName ?? one.name).text);
  });

/** Places that chain the parts of `planJob` themselves. */
export const plannedElsewhere = (sources: Sources): string[] =>
  Object.entries(sources)
    .filter(([file]) => !ENTRIES.includes(file))
    .flatMap(([file, text]) =>
      namesFromSrc(file, text)
        .filter((name) => Object.hasOwn(PARTS_OF_PLANNING, name))
        .filter((name) => !PARTS_OF_PLANNING[name].some((start) => file.startsWith(start)))
        .map((name) => `${file} uses ${name}`),
    );

/** The imports of one search that form a cycle, as a readable chain; empty if there is none. */
export function findCycle(imports: readonly Import[]): string[] {
  const next = new Map<string, string[]>();
  for (const { from, to } of imports) {
    const key = from.replace(/\.tsx?$/, "");
    next.set(key, [...(next.get(key) ?? []), to]);
  }
  const done = new Set<string>();
  const visit = (file: string, before: readonly string[]): string[] => {
    if (before.includes(file)) return [...before.slice(before.indexOf(file)), file];
    if (done.has(file)) return [];
    for (const to of next.get(file) ?? []) {
      const cycle = visit(to, [...before, file]);
      if (cycle.length > 0) return cycle;
    }
    done.add(file);
    return [];
  };
  for (const file of next.keys()) {
    const cycle = visit(file, []);
    if (cycle.length > 0) return cycle;
  }
  return [];
}

/** Only the imports between files of one folder such as "src". */
export const inside = (folder: string, sources: Sources): Import[] =>
  importsOf(sources).filter(({ from, to }) => from.startsWith(`${folder}/`) && to.startsWith(`${folder}/`));

export const cycleOfFiles = (folder: string, sources: Sources): string[] =>
  findCycle(inside(folder, sources));

/**
 * A cycle among folders, including nested ones: "src/drivers/ebb/compile/leg" counts as "src/drivers/ebb/compile".
 * A file beside folders counts as itself.
 */
export function cycleOfFolders(folder: string, sources: Sources): string[] {
  const folders = Object.keys(sources).map((file) => path.posix.dirname(file));
  const isLeaf = (one: string): boolean => !folders.some((other) => other.startsWith(`${one}/`));
  const nodeOf = (file: string): string => {
    const own = path.posix.dirname(file);
    return isLeaf(own) ? own : file.replace(/\.tsx?$/, "");
  };
  const between = inside(folder, sources).map(({ from, to }) => ({ from: nodeOf(from), to: nodeOf(to) }));
  return findCycle(between.filter(({ from, to }) => from !== to));
}
