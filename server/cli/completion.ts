/** `plotwright completion SHELL`: a script that completes commands, options and their values, made from the program itself. */
import { Argument, type Command, type Option } from "commander";
import { MACHINES, PAPER_SIZES } from "../../src/index.js";
import { getOrAdd } from "../../src/internal.js";
import type { Declare } from "./options.js";

/** What can be typed after a command's name. */
interface Completed {
  readonly name: string;
  readonly about: string;
  /** Its own commands, or the choices of its first argument. */
  readonly words: readonly string[];
  readonly options: readonly CompletedOption[];
}

interface CompletedOption {
  readonly flag: string;
  readonly about: string;
  /** Null: it takes no value. */
  readonly values: readonly string[] | "files" | "text" | null;
}

const SHELLS = { bash, zsh, fish } as const;

/** The program's commands have to be loaded. */
export const declareCompletion: Declare = (command, { io }) => {
  command
    .addArgument(new Argument("<shell>", "your shell").choices(Object.keys(SHELLS)))
    .action((shell: keyof typeof SHELLS) => {
      const commands = (command.parent?.commands ?? []).map(completed);
      io.out(SHELLS[shell](commands.filter(({ name }) => name !== "help")));
    });
};

function completed(command: Command): Completed {
  const subs = command.commands.filter((one) => one.name() !== "help");
  const options = [command, ...subs].flatMap((one) => one.options).map(completedOption);
  return {
    name: command.name(),
    about: command.description(),
    words:
      subs.length > 0
        ? subs.map((one) => one.name())
        : (command.registeredArguments[0]?.argChoices ?? WORDS[command.name()] ?? []),
    options: options.filter(({ flag }, i) => options.findIndex((one) => one.flag === flag) === i),
  };
}

const WORDS: Readonly<Record<string, readonly string[]>> = { pen: ["up", "down"] };

/** Values of options that take others too. */
const VALUES: Readonly<Record<string, readonly string[]>> = {
  "--machine": MACHINES.map(({ id }) => id),
  "--paper": Object.keys(PAPER_SIZES),
  "--device": ["virtual"],
};
const FILE = /<(file|folder|path|out)/;

function completedOption({ long, flags, description, argChoices }: Option): CompletedOption {
  const flag = long ?? flags;
  const takesValue = flags.includes("<");
  const values = argChoices ?? VALUES[flag] ?? (FILE.test(flags) ? "files" : "text");
  return { flag, about: description, values: takesValue ? values : null };
}

function bash(commands: readonly Completed[]): string {
  const names = commands.map(({ name }) => name);
  return `# Bash completion of plotwright: source <(plotwright completion bash)
_plotwright() {
  local cur="\${COMP_WORDS[COMP_CWORD]}" prev="\${COMP_WORDS[COMP_CWORD-1]}" command="" words="" options="" i
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "\${COMP_WORDS[i]}" in
      ${names.join("|")}) command="\${COMP_WORDS[i]}"; break ;;
    esac
  done
  COMPREPLY=()
  case "$command $prev" in
${bashValues(commands).join("\n")}
  esac
  case "$command" in
    "") words="${names.join(" ")} help" options="--help --version" ;;
${commands.map((one) => `    ${one.name}) words="${one.words.join(" ")}" options="${flagsOf(one)}" ;;`).join("\n")}
  esac
  if [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$cur"))
  elif [[ -n $words ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$cur"))
  else
    compopt -o default
  fi
}
complete -F _plotwright plotwright
`;
}

const flagsOf = ({ options }: Completed): string =>
  [...options.map(({ flag }) => flag), "--help", "--help-all"].join(" ");

/** The cases of options that take a value, joined where the values are the same. */
function bashValues(commands: readonly Completed[]): string[] {
  const byAction = new Map<string, string[]>();
  for (const { name, options } of commands) {
    for (const { flag, values } of options.filter((one) => one.values !== null)) {
      const list = Array.isArray(values) ? values.join(" ") : "";
      const action =
        values === "files" ? "compopt -o default" : `COMPREPLY=($(compgen -W "${list}" -- "$cur"))`;
      getOrAdd(byAction, action, () => []).push(`"${name} ${flag}"`);
    }
  }
  return [...byAction].map(([action, patterns]) => `    ${patterns.join("|")})\n      ${action}; return ;;`);
}

/** In single quotes of a shell. */
const quoted = (text: string): string => `'${text.replaceAll("'", `'\\''`)}'`;

function zsh(commands: readonly Completed[]): string {
  const described = (text: string): string => text.replace(/[\\[\]:]/g, "\\$&");
  const option = ({ flag, about, values }: CompletedOption): string => {
    const value =
      values === null
        ? ""
        : values === "files"
          ? ":file:_files"
          : `:value:(${values === "text" ? "" : values.join(" ")})`;
    return quoted(`*${flag}[${described(about)}]${value}`);
  };
  const cases = commands.map(({ name, words, options }) => {
    const rest = words.length === 0 ? "*:file:_files" : `1:word:(${words.join(" ")})`;
    return `    ${name}) _arguments ${[...options.map(option), quoted(rest)].join(" \\\n      ")} ;;`;
  });
  return `#compdef plotwright
# Zsh completion of plotwright: source <(plotwright completion zsh), after compinit
_plotwright() {
  local -a commands=(
${commands.map(({ name, about }) => `    ${quoted(`${name}:${about}`)}`).join("\n")}
  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  shift words
  ((CURRENT--))
  case "$words[1]" in
${cases.join("\n")}
  esac
}
compdef _plotwright plotwright
`;
}

function fish(commands: readonly Completed[]): string {
  const line = (when: string, rest: string): string => `complete -c plotwright -n ${quoted(when)} ${rest}`;
  const of = ({ name, words, options }: Completed): string[] => {
    const when = `__fish_seen_subcommand_from ${name}`;
    return [
      ...(words.length === 0 ? [] : [line(when, `-f -a ${quoted(words.join(" "))}`)]),
      ...options.map(({ flag, about, values }) => {
        const value =
          values === null
            ? ""
            : values === "files"
              ? " -r"
              : ` -x -a ${quoted(values === "text" ? "" : values.join(" "))}`;
        return line(when, `-l ${flag.slice(2)}${value} -d ${quoted(about)}`);
      }),
    ];
  };
  return `# Fish completion of plotwright: plotwright completion fish | source
${commands.map(({ name, about }) => line("__fish_use_subcommand", `-f -a ${name} -d ${quoted(about)}`)).join("\n")}
${commands.flatMap(of).join("\n")}
`;
}
