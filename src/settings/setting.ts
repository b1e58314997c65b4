/**
 * The rows of the settings tables. The tables are the only place that defines a default, a range, a unit or a
 * flag: the schema, the checks, the command line, the page's fields and docs/cli.md are derived from them.
 */

/** What the user decides, in the order of the command line's help. */
export const SETTING_GROUPS = ["machine", "paper", "drawing", "lines", "motion", "pen"] as const;
export type SettingGroup = (typeof SETTING_GROUPS)[number];

interface Described {
  /** Shown on the page. */
  readonly label: string;
  /** "--margin"; left out: the command line has no option for it. */
  readonly flag?: string;
  /** What the user decides with it, if it differs from the rest of its table. */
  readonly group?: SettingGroup;
  /** One of the few that the command line's `--help` shows; the others are under `--help-all`. */
  readonly isCommon?: true;
  /** The page's panel that lists it as a plain field; left out: it has custom UI. */
  readonly panel?: "lines";
  /** What happens by default, for a row whose default is "auto". */
  readonly aboutAuto?: string;
}

/** A default that is decided for each drawing. A row with this default takes it as a value too. */
export const AUTO = "auto";
type Auto = typeof AUTO;

export interface NumberSetting extends Described {
  readonly kind: "number";
  readonly default: number | Auto;
  readonly min: number;
  readonly max: number;
  /** `min` itself is not allowed, for example a speed of 0. */
  readonly minExcluded?: true;
  readonly isWhole?: true;
  /** "" for a number without a unit. */
  readonly unit: string;
  /** The increment of an arrow key in the page's field. */
  readonly step: number;
  /** Digits after the decimal point in the page's field; default 2. */
  readonly digits?: number;
  /** Ends of the field's slider: the typical range. */
  readonly slider?: readonly [from: number, to: number];
}

interface SwitchSetting extends Described {
  readonly kind: "switch";
  readonly default: boolean | Auto;
  /** The effect of `--no-…`. */
  readonly aboutOff?: string;
}

interface ChoiceSetting extends Described {
  readonly kind: "choice";
  readonly default: string;
  readonly choices: readonly string[];
}

export type Setting = NumberSetting | SwitchSetting | ChoiceSetting;
export type SettingsTable = Readonly<Record<string, Setting>>;

type ValueOf<S> =
  | (S extends { readonly default: Auto } ? Auto : never)
  | (S extends NumberSetting
      ? number
      : S extends SwitchSetting
        ? boolean
        : S extends { readonly choices: readonly (infer T)[] }
          ? T
          : never);

/** The object that a table describes. */
export type ValuesOf<Table extends SettingsTable> = { readonly [K in keyof Table]: ValueOf<Table[K]> };

export const defaultsOf = <Table extends SettingsTable>(table: Table): ValuesOf<Table> =>
  Object.fromEntries(Object.entries(table).map(([key, row]) => [key, row.default])) as ValuesOf<Table>;

/** Whether a value is within the row's range. */
export const isAllowed = (row: NumberSetting, value: number): boolean =>
  Number.isFinite(value) &&
  (row.minExcluded ? value > row.min : value >= row.min) &&
  value <= row.max &&
  (!row.isWhole || Number.isInteger(value));

/** A range as text: "0 to 1000 mm", "more than 0, up to 1000 mm/s", "a whole number, 0 to 5". */
export function rangeInWords({ min, max, minExcluded, isWhole, unit }: NumberSetting): string {
  const upTo = max === Infinity ? "" : `, up to ${max}`;
  const range = minExcluded ? `more than ${min}${upTo}` : `${min} to ${max}`;
  return `${isWhole ? "a whole number, " : ""}${range}${unit === "" ? "" : ` ${unit}`}`;
}

export const takesAuto = (row: Setting): boolean => row.kind !== "choice" && row.default === AUTO;

/** What a row whose default is "auto" takes, as text: '"auto", or -360 to 360 °'. */
export const orAutoInWords = (row: Setting): string =>
  row.kind === "number" ? `"auto", or ${rangeInWords(row)}` : '"auto", true or false';
