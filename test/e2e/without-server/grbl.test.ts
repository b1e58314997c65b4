/** The page without a server, and a Grbl on its serial port. */
import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { describe, expect, it } from "vitest";
import { MACHINES } from "../../../src/index.js";
import { dropFile, openGroup, openPanel, statusCard } from "../../support/browser/page-actions.js";
import { silentDevice, type GrblOptions } from "../../support/browser/grbl-device.js";
import { done, expectState, storedJob, useSerialPages } from "../../support/browser/serial-page.js";
import { strokesInBrowser } from "../../support/browser/strokes-in-browser.js";
import { gridOf, linesOf, pointsOf } from "../../support/drawings/polylines.js";
import { farthest } from "../../support/drawings/segment-grid.js";
import { IS_FULL } from "../../support/runs/full-run.js";

const PATIENCE_MS = 90_000;
const MOST_AWAY_MM = 0.05;

const startPages = useSerialPages();

async function chooseModel(page: Page, label: string): Promise<void> {
  await openGroup(page, "Plotter", "Model and position");
  await page.getByLabel("Model", { exact: true }).selectOption({ label });
}

type Grbl = readonly [name: string, label: string, device: Omit<GrblOptions, "speed">];
const DRAWCORE: Grbl = [
  "a DrawCore on a CH340",
  "iDraw H A3",
  { chip: "CH340", model: "idraw-h-a3", face: "DrawCore" },
];
const PLAIN: Grbl = [
  "a Grbl 1.1 on a CH340",
  "Plotter with Grbl and a pen servo",
  { chip: "CH340", model: "grbl-servo", face: "1.1" },
];
const FLUIDNC: Grbl = [
  "a FluidNC on a CP2102",
  "Plotter with Grbl and a Z axis",
  { chip: "CP2102", model: "grbl-z", face: "FluidNC" },
];

/** Rows of short lines, of which a Grbl keeps less than a row. */
const BATTLEMENTS = `<svg xmlns="http://www.w3.org/2000/svg" width="150mm" height="100mm" viewBox="0 0 150 100" fill="none" stroke="black">${[
  20, 30, 40,
]
  .map((y) => `<path d="M20 ${y}${"v4h4v-4h4".repeat(15)}"/>`)
  .join("")}</svg>`;

/** Begins to plot battlements on a Grbl. */
async function plotting([, label, options]: Grbl) {
  const pages = await startPages(3);
  const device = pages.plugGrbl(options);
  const page = await pages.openPage();
  await dropFile(page, "battlements.svg", BATTLEMENTS);
  await chooseModel(page, label);
  await pages.plot(page);
  const { machine } = device;
  // It begins the second row.
  const often = { timeout: PATIENCE_MS, interval: 10 };
  await expect.poll(() => machine.state().yMm, often).toBeGreaterThan(25);
  await expect.poll(() => machine.state().penUp, often).toBe(false);
  return { pages, page, device, machine };
}

const whole = { gapMm: expect.closeTo(0, 1), overlapMm: expect.closeTo(0, 1) };

describe.each([DRAWCORE, PLAIN, FLUIDNC].slice(0, IS_FULL ? undefined : 1))("%s", (_, label, device) => {
  it("draws a sample within 0.05 mm", { timeout: 300_000 }, async () => {
    const pages = await startPages(50);
    const { machine } = pages.plugGrbl(device);
    const page = await pages.openPage();
    await page.getByRole("button", { name: "Whirling triangles" }).click();
    await chooseModel(page, label);
    await pages.plot(page);
    await done(page);
    const { settings } = await storedJob(page);
    const svg = readFileSync("samples/whirling-triangles.svg", "utf8");
    const asked = linesOf(await strokesInBrowser(page, svg, settings));
    const drawn = machine.drawn().flatMap(({ penDown, xy }) => (penDown ? [xy] : []));
    expect(machine.state()).toMatchObject({ lostCount: 0, penUp: true });
    expect(farthest(pointsOf(drawn), gridOf(asked))).toBeLessThan(MOST_AWAY_MM);
    expect(farthest(pointsOf(asked), gridOf(drawn))).toBeLessThan(MOST_AWAY_MM);
  });
});

describe("a plot on a Grbl", { timeout: 300_000 }, () => {
  it("is paused with the pen up, and resumed", async () => {
    const { pages, page, machine } = await plotting(PLAIN);
    await statusCard(page).getByRole("button", { name: "Pause" }).click();
    await expectState(page, /^Paused/);
    expect(machine.state()).toMatchObject({ state: "Idle", penUp: true });
    await statusCard(page).getByRole("button", { name: "Resume" }).click();
    await done(page);
    expect(await pages.drawnFaults(page, BATTLEMENTS, machine)).toMatchObject(whole);
  });

  it.each([PLAIN, FLUIDNC, DRAWCORE].slice(0, IS_FULL ? undefined : 2))(
    "on %s survives that the cable is pulled out: the pen is lifted first, and nothing is left out",
    async (...grbl) => {
      const { pages, page, device, machine } = await plotting(grbl);
      pages.serial.unplug();
      await expectState(page, /^Not connected/);
      // It has drawn what it had received, and stopped in the middle of a row.
      await expect.poll(() => machine.state()).toMatchObject({ state: "Idle", penUp: false });
      const { xMm, yMm } = machine.state();
      pages.serial.plug(device);
      await openPanel(page, "Plotter");
      // The browser has forgotten a chip without a serial number.
      if (device.hasSerialNumber) await pages.untilConnected(page);
      else await pages.connect(page);
      await expect.poll(() => machine.state()).toMatchObject({ xMm, yMm, penUp: true });
      await pages.recover(page);
      expect(await pages.drawnFaults(page, BATTLEMENTS, machine)).toMatchObject(whole);
    },
  );

  it("does not begin on one that is locked, and does not unlock it", async () => {
    const [, label, options] = PLAIN;
    const pages = await startPages(3);
    const { machine } = pages.plugGrbl({ ...options, settings: { 22: 1 } });
    const page = await pages.openPage();
    await dropFile(page, "battlements.svg", BATTLEMENTS);
    await chooseModel(page, label);
    await pages.plot(page);
    await page.getByText(/^The Grbl is locked until it is homed .* nothing unlocks it without you/).waitFor();
    expect(machine.state()).toMatchObject({ state: "Alarm", movingS: 0 });
    expect(pages.serial.heard).not.toContain("$X");
  });
});

describe("a port whose board is not one of the model’s controller", { timeout: 300_000 }, () => {
  const alert = (page: Page, words: RegExp) => page.getByRole("alert").filter({ hasText: words });
  const plugIn = (page: Page) => page.getByRole("button", { name: "Connect a plotter…" });
  const fitting = (page: Page, answer: string) =>
    page.getByRole("group", { name: `Models for the ${answer}` });

  it("a Grbl instead of an EiBotBoard is named, and one click on its model connects it", async () => {
    const pages = await startPages(10);
    pages.plugGrbl(DRAWCORE[2]);
    const page = await pages.openPage();
    await openPanel(page, "Plotter");
    await plugIn(page).click();
    await alert(page, /^DrawCore 2.09 answers on this port, but the model has another controller/).waitFor();
    const models = await fitting(page, "DrawCore 2.09").getByRole("button").allInnerTexts();
    expect(models).toEqual(
      MACHINES.filter(({ controller }) => controller.kind === "grbl").map(({ name }) => name),
    );
    await fitting(page, "DrawCore 2.09").getByRole("button", { name: "iDraw H A3" }).click();
    await pages.untilConnected(page);
    await expectState(page, /Ready$/);
    await page.reload();
    await pages.untilConnected(page);
  });

  it("an EiBotBoard instead of a Grbl is named, and one click on its model connects it", async () => {
    const pages = await startPages(10);
    const page = await pages.openPage();
    await chooseModel(page, DRAWCORE[1]);
    await plugIn(page).click();
    await alert(page, /EiBotBoard .* answers on this port, but the model has another controller/).waitFor();
    await fitting(page, "EiBotBoard").getByRole("button", { name: "AxiDraw V3/A3", exact: true }).click();
    await pages.untilConnected(page);
    await expectState(page, /Ready$/);
  });

  it("a Grbl that replaces an EiBotBoard is named too", async () => {
    const pages = await startPages(10);
    const page = await pages.openPage();
    await openPanel(page, "Plotter");
    await pages.connect(page);
    pages.plugGrbl(FLUIDNC[2]);
    await plugIn(page).click();
    await alert(page, /FluidNC .* answers on this port/).waitFor();
  });

  it.each(["AxiDraw V3", "iDraw H A3"])("a silent device is reported for the model %s", async (label) => {
    const pages = await startPages(10);
    pages.serial.plug(silentDevice());
    const page = await pages.openPage();
    await chooseModel(page, label);
    await plugIn(page).click();
    await page.getByText(/^No plotter answers on the port that you chose/).waitFor();
    expect(await plugIn(page).count()).toBe(1);
  });
});
