/** Fields show what the page has: also after a choice that it did not take over. Dialogs and focus belong to them. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { PageTest } from "../../support/browser/page-test.js";

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.open("fields");
});

afterAll(async () => test.close());

describe("the page's fields", () => {
  it("offer the same sample again after it was opened", async () => {
    const { page } = test;
    await test.panel("Drawing");
    const samples = page.getByLabel("Try a sample");
    await samples.selectOption({ label: "Moonrise" });
    await page.locator(".drawn-size").getByText("Moonrise").or(page.getByText("Moonrise")).first().waitFor();
    expect(await samples.inputValue()).toBe("");
  });

  it("have a label in one line also beside long options", async () => {
    await test.panel("Paper");
    await test.page.getByRole("button", { name: "Separate margins, mirror, cutting" }).click();
    const label = test.page.getByText("What lies outside the paper", { exact: true });
    const lines = await label.evaluate((element) => {
      const range = document.createRange();
      range.selectNodeContents(element);
      return range.getClientRects().length;
    });
    expect(lines).toBe(1);
  });

  it("show a plotter's port again when the server refuses another one", async () => {
    const { page } = test;
    await page.getByRole("button", { name: "Sharing, plotters, camera" }).click();
    await page.getByRole("radio", { name: "Plotters" }).check();
    const port = page.getByRole("dialog").getByLabel("Port", { exact: true }).first();
    const before = await port.inputValue();
    expect(before).toBe("virtual");
    await page.route("**/api/v1/plotters/*", (route) => route.abort());
    await port.selectOption("auto");
    expect(await port.inputValue()).toBe(before);
    await page.unroute("**/api/v1/plotters/*");
    await page.keyboard.press("Escape");
    await page.getByRole("dialog").waitFor({ state: "detached" });
  });

  it("stay in the dialog that replaces another one", async () => {
    const { page } = test;
    await page.keyboard.press("Control+k");
    await page.getByRole("combobox", { name: "Search for anything" }).waitFor();
    expect(await page.getByRole("combobox", { name: "Search for anything" }).getAttribute("spellcheck")).toBe(
      "false",
    );
    await page.keyboard.type("console");
    await page.getByRole("dialog").getByRole("option").first().waitFor();
    await page.keyboard.press("Enter");
    const line = page.getByRole("dialog", { name: "Console" }).getByRole("textbox", { name: "Command" });
    await line.waitFor();
    // The close event of the first dialog comes later.
    await page.waitForTimeout(300);
    await line.fill("V");
    await page.keyboard.press("Escape");
    await page.getByRole("dialog").waitFor({ state: "detached" });
  });

  it("logs no error in the browser's console but that of the refused request", () => {
    expect(test.complaints.filter((text) => !text.includes("ERR_FAILED"))).toEqual([]);
  });
});
