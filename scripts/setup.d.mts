export declare const ROOT: string;
export declare function ensureDependencies(): void;
export declare function ensureBuild(): void;
export declare const TEST_SITE: { readonly folder: string; readonly base: string; readonly source: string };
export declare function ensureTestSite(): void;
/** A file of a package in node_modules. */
export declare function nodeModule(...parts: string[]): string;
/** Options of `serve` that npm took for itself, such as --port. */
export declare function optionsTakenByNpm(env: NodeJS.ProcessEnv): string[];
