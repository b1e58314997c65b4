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
