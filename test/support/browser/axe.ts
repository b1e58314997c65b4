/** axe's rules (WCAG 2.2 A and AA, and its best practices) on the current page. */
import axe from "axe-core";
import type { Page } from "playwright-core";

/**
 * Serious and critical findings, one line each: the rule, and the elements concerned. While a sheet is open,
 * of the sheet alone: nothing else can be used then.
 */
export async function seriousFindings(page: Page): Promise<string[]> {
  // Once for each load of a page: reading the source takes as long as a small check.
  if (!(await page.evaluate(() => "axe" in window))) await page.evaluate(axe.source);
  const violations = await page.evaluate(async () => {
    const tool = (window as unknown as { axe: typeof axe }).axe;
    const results = await tool.run(document.querySelector("dialog:modal") ?? document, {
      runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"],
      // The elements that pass take longest to describe.
      resultTypes: ["violations"],
    });
    return results.violations;
  });
  return violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(
      ({ id, help, nodes }) => `${id}: ${help} (${nodes.map(({ target }) => target.join(" ")).join(", ")})`,
    );
}

/** Pairs of controls or words on the page, or on the open sheet, of which one lies over the other. */
export const overlaps = (page: Page): Promise<string[]> =>
  page.evaluate(() => {
    const parts = ".button, .field-box, .text-field, select, .segments, .legend-labels span, .legend p, h2";
    const areas = "dialog, .panel, .plot-bar, .preview-foot, .legend, .watch > *, .strips, .top-bar";
    const sheet = document.querySelector("dialog:modal");
    const found = [...(sheet ?? document).querySelectorAll(parts)]
      .filter((element) => element.checkVisibility() && !element.closest(".ask, .row-menu, .notices"))
      .map((element) => ({
        element,
        box: element.getBoundingClientRect(),
        area: element.closest(areas),
        words: (element.textContent || element.className).slice(0, 30),
      }))
      // Of hidden words a screen reader reads, 1 px is left.
      .filter(({ box }) => box.width > 1 && box.height > 1);
    return found.flatMap((one, index) =>
      found
        .slice(index + 1)
        .filter(({ element, box, area }) => {
          if (area !== one.area || one.element.contains(element)) return false;
          const width = Math.min(one.box.right, box.right) - Math.max(one.box.left, box.left);
          const height = Math.min(one.box.bottom, box.bottom) - Math.max(one.box.top, box.top);
          return width > 1 && height > 1.5;
        })
        .map(({ words }) => `“${one.words}” and “${words}” lie over each other`),
    );
  });
