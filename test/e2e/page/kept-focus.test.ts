/** Removing by keyboard: in every list the focus goes to the next row, or to the list's heading when it is empty. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { plotBar } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";
import { ruledSheet } from "../../support/drawings/drawings.js";

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.firstVisit("kept-focus");
});

afterAll(async () => test.close());

const focused = (): Promise<string> =>
  test.page.evaluate(() => {
    const element = document.activeElement;
    if (!element || element === document.body) return "nothing";
    const label = (element as HTMLInputElement).labels?.[0]?.querySelector("span")?.textContent;
    return (element.getAttribute("aria-label") ?? label ?? element.textContent ?? "").trim();
  });
const press = async (name: string | RegExp): Promise<void> => {
  const exact = typeof name === "string";
  await test.page.getByRole("button", { name, exact }).first().focus();
  await test.page.keyboard.press("Enter");
};
/** By its menu. */
const remove = async (name: string): Promise<void> => {
  await press(`More for ${name}`);
  await press(`Remove ${name}`);
};
const add = async (...names: readonly string[]): Promise<void> => {
  for (const name of names) {
    await test.drop(name, ruledSheet(3));
    await test.queue();
  }
};

describe("the focus after removing a row", () => {
  it("of the queue is on the next plot, on the last one, and then on the queue's heading", async () => {
    await add("fern", "moss", "ivy");
    await test.panel("Queue");
    await remove("moss");
    await expect.poll(focused).toBe("More for ivy");
    await remove("ivy");
    await expect.poll(focused).toBe("More for fern");
    await remove("fern");
    await expect.poll(focused).toBe("Queue");
  });

  it("of the queue stays on a plot that is moved", async () => {
    await add("fern", "moss");
    await press("More for fern");
    await press("Move later: fern");
    await expect.poll(async () => (await test.jobs()).map(({ name }) => name)).toEqual(["moss", "fern"]);
    await expect.poll(focused).toBe("More for fern");
  });

  it("of the recent plots and of the gallery is on the next one, and then on the heading", async () => {
    for (const { id } of await test.jobs()) {
      await test.page.request.post(`${test.server.url}/api/v1/jobs/${id}/start`);
      await expect
        .poll(async () => (await test.jobs()).find((job) => job.id === id)?.state, { timeout: 30_000 })
        .toBe("done");
    }
    await add("ivy");
    const [{ id }] = await test.jobs();
    await test.page.request.post(`${test.server.url}/api/v1/jobs/${id}/start`);
    await expect.poll(async () => (await test.jobs())[0].state, { timeout: 30_000 }).toBe("done");
    await test.panel("Queue");
    await test.page.getByRole("button", { name: "More for moss" }).waitFor();
    // Newest first: ivy, fern, moss.
    await remove("ivy");
    await expect.poll(focused).toBe("More for fern");
    await press("Show all finished plots");
    const gallery = test.page.getByRole("dialog", { name: "Gallery" });
    const inGallery = async (name: string): Promise<void> => {
      for (const label of [`More for ${name}`, `Remove ${name}`]) {
        await gallery.getByRole("button", { name: label, exact: true }).focus();
        await test.page.keyboard.press("Enter");
      }
    };
    await gallery.getByRole("button", { name: "More for moss" }).waitFor();
    await inGallery("fern");
    await expect.poll(focused).toBe("More for moss");
    await inGallery("moss");
    await expect.poll(focused).toBe("Gallery");
    await test.page.keyboard.press("Escape");
  });

  it("of the drawings on a sheet is on the next drawing, and on the last one", async () => {
    await test.drop("leaf", ruledSheet(3));
    await test.panel("Drawing");
    await press("Copies in a grid");
    await press(/^Make 2 × 3/);
    const boxes = test.page.getByRole("list", { name: "Drawings on the sheet" }).getByRole("checkbox");
    await expect.poll(() => boxes.count()).toBe(6);
    const removeNumber = async (number: number): Promise<void> => {
      for (const [index, box] of (await boxes.all()).entries()) await box.setChecked(index === number - 1);
      await test.page
        .getByRole("region", { name: "On the sheet" })
        .getByRole("button", { name: "Remove" })
        .focus();
      await test.page.keyboard.press("Enter");
    };
    await removeNumber(2);
    await expect.poll(() => boxes.count()).toBe(5);
    await expect.poll(focused).toMatch(/^2/);
    await removeNumber(5);
    await expect.poll(() => boxes.count()).toBe(4);
    await expect.poll(focused).toMatch(/^4/);
  });

  it("of the presets and pens is on the next one, and then on the heading", async () => {
    await test.panel("Speed");
    await test.group("Speed", "Presets");
    for (const name of ["Ink", "Wash"]) {
      await test.field("Name of this preset").fill(name);
      await test.page.keyboard.press("Enter");
    }
    await press(/Remove.*Ink/);
    await expect.poll(focused).toMatch(/Remove.*Wash/);
    await press(/Remove.*Wash/);
    await expect.poll(focused).toMatch(/^Presets/);
    await test.group("Layers", "Pens");
    for (let i = 0; i < 2; i++) await press("Add a pen");
    await press("Settings of the pen Pen 1");
    await press("Remove the pen Pen 1");
    await expect.poll(focused).toBe("Settings of the pen Pen 2");
  });

  it("of the keys for scripts is on the next one, and then on the dialog's heading", async () => {
    await press("Sharing, plotters, camera");
    await test.page.getByRole("radio", { name: "Access" }).check();
    const dialog = test.page.getByRole("dialog", { name: "Sharing" });
    for (const name of ["one", "two"]) {
      await dialog.getByRole("textbox", { name: "What it is for" }).fill(name);
      await test.page.keyboard.press("Enter");
      await dialog.getByRole("button", { name: new RegExp(`${name}$`) }).waitFor();
    }
    const revoke = async (name: string): Promise<void> => {
      await dialog.getByRole("button", { name: `Revoke ${name}` }).focus();
      await test.page.keyboard.press("Enter");
    };
    await revoke("one");
    await expect.poll(focused).toBe("Revoke two");
    await revoke("two");
    await expect.poll(focused).toBe("Sharing");
  });

  it("stays on a button that is off while its request is under way", async () => {
    const { page } = test;
    await page.keyboard.press("Escape");
    await test.drop("tide", ruledSheet(3));
    let answer = (): void => undefined;
    const isAnswered = new Promise<void>((resolve) => (answer = resolve));
    await page.route(/\/api\/v1\/jobs\b/, async (route) => {
      await isAnswered;
      await route.continue();
    });
    const button = plotBar(page).getByRole("button", { name: "Add to queue" });
    await press("Add to queue");
    await button.and(page.locator(":disabled")).waitFor();
    answer();
    await button.and(page.locator(":enabled")).waitFor();
    await expect.poll(focused).toBe("Add to queue");
    await page.unroute(/\/api\/v1\/jobs\b/);
  });

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});
