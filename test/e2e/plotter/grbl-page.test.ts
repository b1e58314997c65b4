/** The page for a plotter with a Grbl behind a real pseudo-terminal: setting it up, and a cable that is pulled. */
import type { Browser, Locator, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { machineById } from "../../../src/index.js";
import { machineListSchema } from "../../../src/schema/index.js";
import { overlaps, seriousFindings } from "../../support/browser/axe.js";
import { launchBrowser, PLAIN } from "../../support/browser/browser.js";
import {
  chooseSample,
  openGroup,
  openPanel,
  plotBar,
  statusCard,
} from "../../support/browser/page-actions.js";
import { temporaryFolder } from "../../support/processes/folders.js";
import { PtyGrbl } from "../../support/processes/pty-grbl.js";
import { startServerProcess, type ServerProcess } from "../../support/processes/server-process.js";
import { send } from "../../support/servers/shared-servers.js";

const SPEED = 5;
const MODEL = "idraw-h-a4";

const data = temporaryFolder("grbl-page");
let browser: Browser;
let board: PtyGrbl;
let server: ServerProcess;
let page: Page;

beforeAll(async () => {
  browser = await launchBrowser();
  board = await PtyGrbl.open({ machine: machineById(MODEL), face: "DrawCore", speed: SPEED });
  server = await startServerProcess({
    dataDir: data.path,
    virtualSpeed: SPEED,
    args: ["--device", board.path],
  });
  await send(server.url, "PATCH", "/plotters/main", { machine: MODEL });
  page = await browser.newPage({ ...PLAIN, viewport: { width: 1440, height: 900 } });
  await page.goto(server.url);
  await page.getByText("Plotter: Ready").waitFor();
});

afterAll(async () => {
  await browser.close();
  await server.stop();
  await board.close();
  data.remove();
});

const expectSound = async (): Promise<void> => {
  expect(await seriousFindings(page)).toEqual([]);
  expect(await overlaps(page)).toEqual([]);
};

describe("a plotter with a Grbl", () => {
  it("has its model beside the label, although other models have long names", async () => {
    await openGroup(page, "Plotter", "Model and position");
    const field = page.locator(".machine-set-up .field").filter({ hasText: /^Model/ });
    const label = (await field.locator(".field-label, label").first().boundingBox())!;
    const choice = (await field.locator("select").boundingBox())!;
    const wordsMm = await field
      .locator(".field-label, label")
      .first()
      .evaluate((element) => element.scrollWidth);
    expect(label.x + Math.max(label.width, wordsMm)).toBeLessThanOrEqual(choice.x);
    await openGroup(page, "Plotter", "Model and position", false);
  });

  describe("in the wizard", () => {
    const wizard = (): Locator => page.getByRole("dialog", { name: "Set up a plotter" });
    const press = (name: string): Promise<void> =>
      wizard().getByRole("button", { name, exact: true }).click();
    /** Presses, and waits for the end of that move. */
    const move = async (name: string, route: string): Promise<void> => {
      const answered = page.waitForResponse(
        (response) => response.request().method() === "POST" && response.url().endsWith(route),
      );
      await press(name);
      expect((await answered).status()).toBe(200);
    };

    it("is not asked about motors, which the Grbl mixes by itself", async () => {
      await page.getByRole("button", { name: "Set up a plotter…" }).click();
      await press("Next");
      await move("It is in the middle", "/set-home");
      await wizard().getByText("a CoreXY needs firmware for CoreXY").waitFor();
      expect(
        await wizard()
          .getByRole("button", { name: /Diagonally/ })
          .count(),
      ).toBe(0);
      await expectSound();
      await move("Move 20 mm to the right", "/jog");
      await press("Right");
      await move("Move 20 mm nearer", "/jog");
      await press("Nearer to me");
      await press("Yes, both are right");
      await move("Set home here", "/set-home");
    });

    it("says what to set in the Grbl, which counts the steps, if the square has a wrong size", async () => {
      await move("Draw the square", "/square");
      await wizard().getByText("That is the right size.").waitFor();
      await wizard().getByLabel("Measured width").fill("98");
      await wizard().getByText("Multiply $101 by 1.0204, and").waitFor();
      await wizard().getByLabel("Measured height").fill("101");
      await wizard().getByText("Multiply $100 by 0.9901 and $101 by 1.0204, and").waitFor();
      await expectSound();
      await press("Next");
    });

    it("sets how the pen is lifted, and tries it", async () => {
      await wizard().getByLabel("Z with the pen down", { exact: true }).fill("6");
      await move("Lower and lift the pen", "/cycle-pen");
      expect((await board.report()).state.penUp).toBe(true);
      await expectSound();
      await press("Next");
      await wizard().getByLabel("Name").fill("Old Friend");
      await press("Save and use");
      await wizard().waitFor({ state: "detached" });
      const { machines } = machineListSchema.parse(
        await (await fetch(`${server.url}/api/v1/machines`)).json(),
      );
      const { stepsPerMm, motors } = machineById(MODEL);
      expect(machines.find(({ id }) => id === "old-friend")).toMatchObject({
        stepsPerMm,
        motors,
        controller: { kind: "grbl", penDownZMm: 6, penUpZMm: 0.5 },
      });
    });

    it("has no choice of belts in its profile either", async () => {
      await page.getByRole("button", { name: "Machines…" }).click();
      const dialog = page.getByRole("dialog", { name: "Machines" });
      await dialog.getByRole("button", { name: "Edit Old Friend" }).click();
      await dialog.getByLabel("Steps per mm").waitFor();
      expect(await dialog.getByText("CoreXY").count()).toBe(0);
      await page.keyboard.press("Escape");
    });
  });

  it("says on a phone with a panel open why its plot was interrupted", async () => {
    await chooseSample(page);
    await plotBar(page).getByRole("button", { name: "Plot", exact: true, disabled: false }).click();
    await statusCard(page).getByRole("button", { name: "Pause" }).waitFor();
    await expect.poll(async () => (await board.report()).state.penUp).toBe(false);
    board.tell("unplug");
    const why = statusCard(page).getByText(/check its USB cable and power/);
    await why.waitFor();
    await page.setViewportSize({ width: 390, height: 844 });
    await openPanel(page, "Queue");
    await why.waitFor();
    await expectSound();
  });
});
