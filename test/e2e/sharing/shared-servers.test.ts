/**
 * The queue that servers share, on the page: a job that waits for a model, and a plotter without a known
 * model.
 */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { SharedDatabase } from "../../support/servers/shared-servers.js";
import { PageTest } from "../../support/browser/page-test.js";

let database: SharedDatabase;
let test: PageTest;

beforeAll(async () => {
  database = await SharedDatabase.open();
  test = await PageTest.open("shared-page", {}, ["--shared-queue", database.url]);
});
afterAll(async () => {
  await test.close();
  await database.close();
});

describe("a drawing put in the shared queue for any plotter of a model", () => {
  it("waits, shows the plotter that is left out, and is moved there with one click", async () => {
    const { page } = test;
    await page.getByRole("button", { name: "Sharing, plotters, camera" }).click();
    await page.getByRole("radio", { name: "Servers" }).check();
    await page.getByRole("button", { name: /^Add “/ }).click();
    const row = page.getByRole("listitem").filter({ hasText: "for any AxiDraw V3" });
    await row.getByText(/is left out: its model is not set/).waitFor();
    expect(await test.jobs()).toEqual([]);
    await row.getByRole("button", { name: /^Its model: AxiDraw V3/ }).click();
    await row.getByText("taken", { exact: false }).waitFor();
    await row.getByText(/is left out/).waitFor({ state: "detached" });
    // It is claimed first, then planned, then in the queue.
    await expect
      .poll(async () => (await test.jobs()).map(({ state }) => state), { timeout: 30_000 })
      .toEqual(["queued"]);
    expect(test.complaints).toEqual([]);
  });
});
