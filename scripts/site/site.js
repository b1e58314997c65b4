/** The documentation's only script: menu on a phone, search in titles, and pages for offline use. */
const at = (id) => document.getElementById(id);
const wide = matchMedia("(min-width: 75rem)");

// Before the body is drawn: the menu starts closed on a phone. Without scripts it stays open.
document.documentElement.classList.add("has-script");

document.addEventListener("DOMContentLoaded", () => {
  const menu = at("menu");
  menu.addEventListener("click", () => {
    const isOpen = at("navigation").classList.toggle("open");
    menu.setAttribute("aria-expanded", String(isOpen));
  });
  const contents = document.querySelector(".contents");
  const fit = () => contents?.toggleAttribute("open", wide.matches);
  wide.addEventListener("change", fit);
  fit();
  document.querySelector("[aria-current]")?.scrollIntoView({ block: "nearest" });
  at("search").addEventListener("input", ({ target }) => void showFound(target.value));
});

let titles = null;

async function showFound(text) {
  const docs = new URL("./", document.querySelector("link[rel=stylesheet]").href);
  titles ??= fetch(new URL("titles.json", docs)).then((response) => response.json());
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const found = (await titles).filter(({ title, page }) =>
    words.every((word) => `${page} ${title}`.toLowerCase().includes(word)),
  );
  at("found").hidden = words.length === 0;
  at("pages").hidden = words.length > 0;
  at("found").replaceChildren(...(found.length > 0 ? found.slice(0, 30).map(item) : [nothing()]));

  function item({ title, page, href }) {
    const link = document.createElement("a");
    link.href = new URL(href, docs).href;
    link.textContent = title;
    const where = document.createElement("small");
    where.textContent = page === title ? "" : page;
    link.append(" ", where);
    const row = document.createElement("li");
    row.append(link);
    return row;
  }

  function nothing() {
    const row = document.createElement("li");
    row.textContent = "No title has these words.";
    return row;
  }
}

if (window.isSecureContext && "serviceWorker" in navigator && location.pathname.includes("/docs/")) {
  window.addEventListener("load", () => {
    // Without it only reading offline is lost, so there is no message.
    navigator.serviceWorker.register("service-worker.js").catch(() => undefined);
  });
}
