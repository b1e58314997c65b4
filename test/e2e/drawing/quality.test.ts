/** Quality: a choice of three sets speed, acceleration and corners together; the numbers can still be edited. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { motionOfQuality, type Quality } from "../../../src/internal.js";
import type { MachineProfile } from "../../../src/index.js";
import { seriousFindings } from "../../support/browser/axe.js";
import { chooseMeasuredPlotter, SPRINGS } from "../../support/browser/measured-plotter.js";
import { PageTest } from "../../support/browser/page-test.js";

const PATIENCE_MS = 120_000;
const STEPS = `<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="120mm" viewBox="0 0 120 120"><path d="M10 10v25h25v25h25v25h25" fill="none" stroke="#000"/></svg>`;

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.firstVisit("quality");
  await test.drop("steps", STEPS);
  await test.panel("Speed");
}, PATIENCE_MS);

afterAll(async () => test.close());

const section = () => test.page.locator("#group-motion");
const step = (name: string) => section().getByRole("radio", { name, exact: true });
const motionOfJob = async () => (await test.queue()).settings.motion;
const limitsOf = ({ shaper, draw, travel }: Awaited<ReturnType<typeof motionOfJob>>) => ({
  shaper: shaper ?? "none",
  draw,
  travel,
});

describe("the section of the speeds", () => {
  it("has the default limits as Normal for a plotter that was not measured, and leads to the ringing sheet", async () => {
    expect(await step("Normal").isChecked()).toBe(true);
    expect(await step("Fine").isDisabled()).toBe(true);
    expect(await step("Fast").isDisabled()).toBe(true);
    await section()
      .getByText(/Ten minutes with the ringing sheet/)
      .waitFor();
    expect(limitsOf(await motionOfJob())).toEqual(motionOfQuality("normal", null));
    await section().getByRole("button", { name: "Measure ringing…" }).click();
    const dialog = test.page.getByRole("dialog", { name: "Measure ringing" });
    await dialog.waitFor();
    await test.page.keyboard.press("Escape");
  });

  it("sets the limits of the chosen quality, computed from the plotter's springs", async () => {
    const { page } = test;
    await chooseMeasuredPlotter(page, test.server.url);
    await test.panel("Speed");
    // Normal stays Normal: that of this machine.
    await section().getByText("15 Hz along x and 25 Hz along y", { exact: false }).waitFor();
    expect(await step("Normal").isChecked()).toBe(true);
    const times: string[] = [];
    for (const quality of ["fine", "normal", "fast"] as const satisfies readonly Quality[]) {
      await step(quality[0].toUpperCase() + quality.slice(1)).check();
      await test.planned();
      times.push(await page.getByRole("region", { name: "Plot", exact: true }).innerText());
      expect(limitsOf(await motionOfJob())).toEqual(motionOfQuality(quality, SPRINGS));
    }
    expect(new Set(times).size).toBe(3);
  });

  it("is Custom once a number was changed, until a quality is chosen again", async () => {
    await section().getByText("Details", { exact: true }).click();
    const speed = section().getByRole("group", { name: "Pen down" }).getByLabel("Speed", { exact: true });
    await speed.fill("33");
    expect(await step("Custom").isChecked()).toBe(true);
    expect((await motionOfJob()).draw.speedMmPerS).toBe(33);
    expect((await motionOfJob()).shaper).toBe("zv");
    // The same place each time: a control half under the plot bar is too small a target.
    await section().evaluate((element) => element.scrollIntoView());
    for (const colorScheme of ["light", "dark"] as const) {
      await test.page.emulateMedia({ colorScheme });
      // A busy computer is still adding the queued job to the page.
      await expect.poll(() => seriousFindings(test.page), { timeout: 20_000 }).toEqual([]);
    }
    await step("Fine").check();
    expect(await step("Custom").count()).toBe(0);
    expect(limitsOf(await motionOfJob())).toEqual(motionOfQuality("fine", SPRINGS));
  });

  it("has limits of one axis, none until they are set", async () => {
    const speedX = section().getByLabel("Speed along x", { exact: true });
    expect(await speedX.inputValue()).toBe("");
    const time = () => test.page.locator(".plot-time-value").innerText();
    const before = await time();
    await speedX.fill("4");
    await section().getByLabel("Acceleration along y", { exact: true }).fill("300");
    await expect.poll(time).not.toBe(before);
    expect(await motionOfJob()).toMatchObject({ speedXMmPerS: 4, accelYMmPerS2: 300 });
    await section().getByRole("button", { name: "Speed along x: no limit" }).click();
    await section().getByRole("button", { name: "Acceleration along y: no limit" }).click();
    expect(await motionOfJob()).toMatchObject({ speedXMmPerS: null, accelYMmPerS2: null });
    await expect.poll(time).toBe(before);
  });

  it("is not used by the set-up of another plotter, which moves without shaping", async () => {
    const { page } = test;
    expect((await motionOfJob()).shaper).toBe("zv");
    const wizard = page.getByRole("dialog", { name: "Set up a plotter" });
    const press = (name: string): Promise<void> => wizard.getByRole("button", { name, exact: true }).click();
    await test.panel("Plotter");
    await page.getByRole("button", { name: "Set up a plotter…" }).click();
    await press("Next");
    await press("It is in the middle");
    const answered = page.waitForResponse((response) => response.url().endsWith("/jog"));
    await press("Move 20 mm to the right");
    const answer = await answered;
    // A profile without springs: a shaped move would be refused.
    const { profile } = answer.request().postDataJSON() as { profile: MachineProfile };
    expect([answer.status(), profile.id, profile.springs ?? null]).toEqual([200, "my-plotter", null]);
    await page.keyboard.press("Escape");
  });

  it("shapes a motion or softens it, not both", async () => {
    await test.panel("Speed");
    await section().getByRole("radio", { name: "Gentle" }).check();
    expect(await motionOfJob()).toMatchObject({ mode: "scurve", shaper: "none" });
    await section().getByLabel("Reduce ringing").selectOption("zv");
    expect(await motionOfJob()).toMatchObject({ mode: "blend", shaper: "zv" });
    expect(test.complaints).toEqual([]);
  });
});
