/**
 * Keeps the focus. In lists, wherever a row is removed, the next row gets it, or the last one, or the heading of the list;
 * a row that is moved keeps it, and so does a control that was off for a while. Otherwise the browser gives it to nothing,
 * and someone without a mouse begins at the top of the page again.
 */

const ROWS = "li, tr";
const CONTROLS = ":is(button, input, select, textarea, summary, a[href]):not(:disabled)";

interface Place {
  readonly element: HTMLElement;
  /** Null: it is in no list. */
  readonly list: Element | null;
  /** The list, and what is around it up to its section. */
  readonly around: readonly Element[];
  readonly rowIndex: number;
  /** Of the control in its row. */
  readonly controlIndex: number;
}

export function keepFocus(): void {
  let last: Place | null = null;
  document.addEventListener("focusin", ({ target }) => {
    last = placeOf(target as HTMLElement);
  });
  document.addEventListener("focusout", ({ target }) =>
    setTimeout(() => {
      // Taken away by the user, not by the end of its row or because it is off.
      const isLeft =
        last?.element === target && last.element.isConnected && !last.element.matches(":disabled");
      if (isLeft && document.activeElement !== target) last = null;
    }),
  );
  new MutationObserver((changes) => {
    if (last === null || document.activeElement !== document.body) return;
    const { element } = last;
    if (element.isConnected) {
      const isBack = changes.some(
        ({ target, removedNodes }) =>
          target === element || [...removedNodes].some((node) => node.contains(element)),
      );
      if (isBack) element.focus({ preventScroll: true });
      return;
    }
    const next = controlNear(last) ?? headingOf(last);
    last = null;
    next?.focus();
  }).observe(document.body, {
    childList: true,
    subtree: true,
    attributes: true,
    attributeFilter: ["disabled"],
  });
}

function placeOf(element: HTMLElement): Place {
  const row = element.closest(ROWS);
  const list = row?.parentElement ?? null;
  if (!row || !list) return { element, list: null, around: [], rowIndex: 0, controlIndex: 0 };
  const around = [list];
  for (let at: Element | null = list; at && !at.matches("section, aside, dialog"); at = at.parentElement) {
    if (at.parentElement) around.push(at.parentElement);
  }
  const rowIndex = [...list.children].indexOf(row);
  const controlIndex = [...row.querySelectorAll(CONTROLS)].indexOf(element);
  return { element, list, around, rowIndex, controlIndex };
}

/** The same control of the row that is now at its place, or of the nearest one that has controls. */
function controlNear({ list, rowIndex, controlIndex }: Place): HTMLElement | null {
  if (!list?.isConnected) return null;
  const rows = [...list.children].map((row) => row.querySelectorAll<HTMLElement>(CONTROLS));
  const inOrder = [...rows.slice(rowIndex), ...rows.slice(0, rowIndex).reverse()];
  const controls = inOrder.find(({ length }) => length > 0);
  return controls ? controls[Math.max(0, Math.min(controlIndex, controls.length - 1))] : null;
}

/** The heading before the list, in its section or dialog. */
function headingOf({ around }: Place): HTMLElement | null {
  const left = around.filter(({ isConnected }) => isConnected);
  const heading = left
    .map((one) =>
      [...one.querySelectorAll<HTMLElement>("h2, h3, legend")]
        .filter((head) => isBefore(head, left[0]))
        .at(-1),
    )
    .find(Boolean);
  if (!heading) return null;
  heading.tabIndex = -1;
  return heading;
}

const isBefore = (one: Node, other: Node): boolean =>
  Boolean(
    one.compareDocumentPosition(other) & (Node.DOCUMENT_POSITION_FOLLOWING | Node.DOCUMENT_POSITION_CONTAINS),
  );
