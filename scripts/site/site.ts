/** The site's script: theme, menu on a phone, buttons that copy code, search, and pages for offline use. */
import type { Found, searchIn } from "./search.js";

const at = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const root = document.documentElement;
/** The folder docs/, with all that the pages share. */
const docs = new URL("./", (document.currentScript as HTMLScriptElement).src);

// Before the body is drawn: the menu starts closed on a phone, and the theme does not flash. Without scripts the menu stays
// open, and the theme is the system's.
root.classList.add("has-script");
const THEME_KEY = "plotwright-docs-theme";
setTheme(storedTheme());

document.addEventListener("DOMContentLoaded", () => {
  startMenu();
  startTheme();
  startContents();
  if ("clipboard" in navigator) document.querySelectorAll<HTMLElement>(".code").forEach(addCopyButton);
  startSearch();
});

function startMenu(): void {
  // The start page has none.
  const menu = document.getElementById("menu");
  menu?.addEventListener("click", () => {
    const isOpen = at("navigation").classList.toggle("open");
    menu.setAttribute("aria-expanded", String(isOpen));
  });
  document.querySelector("[aria-current]")?.scrollIntoView({ block: "nearest" });
}

function startTheme(): void {
  const choice = at<HTMLSelectElement>("theme");
  choice.value = storedTheme();
  choice.addEventListener("change", () => {
    setTheme(choice.value);
    try {
      localStorage.setItem(THEME_KEY, choice.value);
    } catch {
      // The browser stores nothing for this site: the theme holds for this page.
    }
  });
}

function storedTheme(): string {
  try {
    return localStorage.getItem(THEME_KEY) ?? "system";
  } catch {
    return "system";
  }
}

function setTheme(theme: string): void {
  if (theme === "light" || theme === "dark") root.dataset["theme"] = theme;
  else delete root.dataset["theme"];
}

/** The page's table of contents is open where there is room beside the text. */
function startContents(): void {
  const wide = matchMedia("(min-width: 75rem)");
  const contents = document.querySelector(".contents");
  const fit = () => contents?.toggleAttribute("open", wide.matches);
  wide.addEventListener("change", fit);
  fit();
}

const COPIED_MS = 2_000;

function addCopyButton(code: HTMLElement): void {
  const button = document.createElement("button");
  button.type = "button";
  button.className = "copy";
  button.textContent = "Copy";
  button.addEventListener("click", () => {
    navigator.clipboard.writeText(code.querySelector("code")?.textContent ?? "").then(
      () => say("Copied"),
      () => say("Not allowed"),
    );
  });
  code.append(button);

  function say(words: string): void {
    button.textContent = words;
    setTimeout(() => (button.textContent = "Copy"), COPIED_MS);
  }
}

function startSearch(): void {
  const field = at<HTMLInputElement>("search");
  let loading: Promise<(words: string) => Found[]> | null = null;
  const load = () =>
    (loading ??= loadSearch().catch((error: unknown) => ((loading = null), Promise.reject(error))));
  field.addEventListener("focus", () => void load().catch(() => undefined));
  field.addEventListener("input", () => void showFound(field, load));
  document.addEventListener("keydown", (event) => {
    const isTyping = event.target instanceof Element && event.target.matches("input, select, textarea");
    if (event.key === "/" && !isTyping) {
      event.preventDefault();
      field.focus();
    }
    if (event.key === "Escape" && !at("found").hidden) {
      closeFound();
      field.focus();
    }
  });
  document.addEventListener("click", ({ target }) => {
    if (target instanceof Element && target.closest("#finder") === null) closeFound();
  });
}

const closeFound = (): void => void (at("found").hidden = true);

async function loadSearch(): Promise<(words: string) => Found[]> {
  const [code, index] = await Promise.all([
    import(new URL("search.js", docs).href) as Promise<{ searchIn: typeof searchIn }>,
    fetch(new URL("search-index.json", docs)).then((response) => response.text()),
  ]);
  return code.searchIn(index);
}

async function showFound(
  field: HTMLInputElement,
  load: () => Promise<(words: string) => Found[]>,
): Promise<void> {
  const words = field.value.trim();
  const list = at("found");
  list.hidden = words === "";
  if (words === "") return;
  let rows: HTMLElement[];
  try {
    const found = (await load())(words);
    rows = found.length > 0 ? found.map(rowOf) : [note(`Nothing found for “${words}”.`)];
  } catch {
    rows = [note("The search could not be loaded. Try again when there is a network.")];
  }
  // What was typed meanwhile has a later call.
  if (field.value.trim() === words) list.replaceChildren(...rows);
}

function rowOf({ title, page, href, excerpt }: Found): HTMLElement {
  const link = document.createElement("a");
  link.href = new URL(href, docs).href;
  const heading = document.createElement("strong");
  heading.textContent = title;
  const where = document.createElement("small");
  where.textContent = page === title ? "" : page;
  const text = document.createElement("span");
  text.append(
    ...excerpt.map((piece) => {
      if (!piece.isMatch) return piece.text;
      const mark = document.createElement("mark");
      mark.textContent = piece.text;
      return mark;
    }),
  );
  link.append(heading, " ", where, text);
  link.addEventListener("click", closeFound);
  const row = document.createElement("li");
  row.append(link);
  return row;
}

function note(words: string): HTMLElement {
  const row = document.createElement("li");
  row.className = "note";
  row.textContent = words;
  return row;
}

if (window.isSecureContext && "serviceWorker" in navigator) {
  window.addEventListener("load", () => {
    // Without it only reading offline is lost, so there is no message.
    navigator.serviceWorker.register(new URL("../service-worker.js", docs)).catch(() => undefined);
  });
}
