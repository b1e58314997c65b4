import tseslint from "typescript-eslint";
import reactHooks from "eslint-plugin-react-hooks";
import { plainWords } from "./scripts/lint/plain-words.mjs";

// Who may import whom is written in ARCHITECTURE.md; these rules hold it.
const onlyEntryPoints = (folder) => ({
  regex: "/src/(?!index\\.js$|internal\\.js$|schema/index\\.js$)",
  message: `${folder} uses src only through src/index.js, src/internal.js and src/schema/index.js: anything else in src may change without notice.`,
});

/** One program with all code: with one for each folder, src would be parsed and checked six times. */
const typed = { parserOptions: { project: "test/tsconfig.json", tsconfigRootDir: import.meta.dirname } };

export default tseslint.config(
  { ignores: ["dist/", "node_modules/", "coverage/"] },
  ...tseslint.configs.recommended,
  {
    rules: {
      "@typescript-eslint/no-unused-vars": ["error", { argsIgnorePattern: "^_" }],
      "@typescript-eslint/no-explicit-any": "error",
      "no-console": "error",
      eqeqeq: "error",
    },
  },
  {
    files: ["{src,host,server,web,test,scripts,bench}/**/*.{ts,tsx}"],
    plugins: { plotwright: { rules: { "plain-words": plainWords } } },
    rules: { "plotwright/plain-words": "error" },
  },
  {
    files: ["{src,host,server,web,test,scripts}/**/*.{ts,tsx}"],
    languageOptions: typed,
    rules: { "@typescript-eslint/no-unnecessary-type-assertion": "error" },
  },
  {
    files: ["src/**/*.ts", "host/**/*.ts", "server/**/*.ts", "web/**/*.{ts,tsx}"],
    languageOptions: typed,
    rules: {
      "@typescript-eslint/no-floating-promises": "error",
      "@typescript-eslint/no-misused-promises": ["error", { checksVoidReturn: { attributes: false } }],
    },
  },
  // One way for private members in each layer. Private constructors have no other form.
  {
    files: ["src/**/*.ts"],
    rules: {
      "no-restricted-syntax": [
        "error",
        { selector: "PrivateIdentifier", message: "In src a private member is written private name." },
      ],
    },
  },
  {
    files: ["host/**/*.ts", "server/**/*.ts", "web/**/*.{ts,tsx}"],
    rules: {
      "no-restricted-syntax": [
        "error",
        {
          selector:
            ":matches(PropertyDefinition, MethodDefinition[kind!='constructor'], TSParameterProperty)[accessibility='private']",
          message: "In host, server and web a private member is written #name.",
        },
      ],
    },
  },
  {
    files: ["src/**/*.ts"],
    rules: {
      "no-restricted-imports": [
        "error",
        {
          patterns: [
            {
              group: ["node:*", "fs", "path", "express", "serialport", "react", "react-dom", "ws"],
              message:
                "src runs anywhere: it knows nothing of Node, the DOM or a framework. Take what you need as an interface argument.",
            },
            {
              group: ["**/server/**", "**/web/**", "**/test/**"],
              message: "src knows nothing of server, web or test.",
            },
            {
              group: ["**/src/index.js", "../index.js", "./index.js", "../internal.js", "./internal.js"],
              message: "inside src import the file itself, not the barrel: barrels make cycles.",
            },
          ],
        },
      ],
      "no-restricted-globals": [
        "error",
        "process",
        "window",
        "document",
        "Buffer",
        "console",
        "setTimeout",
        "performance",
      ],
    },
  },
  {
    files: ["host/**/*.ts"],
    rules: {
      "no-restricted-imports": [
        "error",
        {
          patterns: [
            onlyEntryPoints("host"),
            {
              group: ["node:*", "**/server/**", "**/web/**", "**/test/**"],
              message:
                "host runs in Node and in a browser's worker: take what you need as an interface argument.",
            },
          ],
        },
      ],
    },
  },
  {
    files: ["server/**/*.ts"],
    rules: {
      "no-restricted-imports": [
        "error",
        {
          patterns: [
            onlyEntryPoints("server"),
            {
              group: ["**/web/**", "**/test/**"],
              message: "server and web never import each other; what they exchange is in src/schema.",
            },
          ],
        },
      ],
      "no-console": "off",
    },
  },
  {
    files: ["web/**/*.{ts,tsx}"],
    plugins: { "react-hooks": reactHooks },
    rules: {
      ...reactHooks.configs.recommended.rules,
      "no-restricted-imports": [
        "error",
        {
          patterns: [
            onlyEntryPoints("web"),
            {
              group: ["**/server/**", "!**/backend/server/**", "!./server/**", "**/test/**", "node:*"],
              message: "server and web never import each other; what they exchange is in src/schema.",
            },
          ],
        },
      ],
    },
  },
  {
    // The types of vite bring Node's globals with them.
    files: ["web/**/*.{ts,tsx}"],
    ignores: ["web/vite.config.ts"],
    rules: {
      "no-restricted-globals": [
        "error",
        ...["process", "Buffer", "global", "require", "__dirname", "__filename", "setImmediate"],
      ],
    },
  },
  { files: ["scripts/**", "test/**", "bench/**"], rules: { "no-console": "off" } },
);
