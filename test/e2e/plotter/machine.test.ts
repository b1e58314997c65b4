/** Moving a plotter by hand, setting one up, and the console, from the page, on the virtual board. */
import type { Browser, Locator, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { MachineProfile } from "../../../src/index.js";
import { machineListSchema, snapshotSchema, type Plotter } from "../../../src/schema/index.js";
import { launchBrowser, PLAIN } from "../../support/browser/browser.js";
import { ruledSheet } from "../../support/drawings/drawings.js";
import {
  chooseSample,
  dropFile,
  historyPanel,
  openPanel,
  openView,
  plotBar,
  queuePanel,
  statusCard,
  waitForPlan,
} from "../../support/browser/page-actions.js";
import { temporaryFolder } from "../../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../../support/processes/server-process.js";

const data = temporaryFolder("machine");
let browser: Browser;
let server: ServerProcess;
let page: Page;

beforeAll(async () => {
  browser = await launchBrowser();
  server = await startServerProcess({ dataDir: data.path, virtualSpeed: 2 });
  page = await browser.newPage({ ...PLAIN, viewport: { width: 900, height: 600 } });
  await page.goto(server.url);
  await chooseSample(page);
});

afterAll(async () => {
  await browser.close();
  await server.stop();
  data.remove();
});

const machinePanel = (): Locator => page.getByRole("region", { name: "Plotter" });
const button = (name: string | RegExp, within: Page | Locator = page): Locator =>
  within.getByRole("button", { name, exact: typeof name === "string" });

async function plotter(): Promise<Plotter> {
  const state: unknown = await (await fetch(`${server.url}/api/v1/state`)).json();
  return snapshotSchema.parse(state).plotters[0];
}

/** Clicks, and waits until the server has answered with the plotter's new position. */
async function move(
  press: () => Promise<void>,
  route = "",
): Promise<[xMm: number | null, yMm: number | null]> {
  const answered = page.waitForResponse(
    (response) => response.request().method() === "POST" && response.url().endsWith(route),
  );
  await press();
  const answer = await answered;
  expect([answer.status(), answer.ok() ? "" : await answer.text()]).toEqual([200, ""]);
  const { xMm, yMm } = await plotter();
  return [xMm, yMm];
}

const close = (place: readonly (number | null)[], xMm: number, yMm: number): void => {
  expect(place[0]).toBeCloseTo(xMm, 1);
  expect(place[1]).toBeCloseTo(yMm, 1);
};

describe("moving by hand", () => {
  it("jogs by the step in the direction of the key, by mouse and by the arrow keys", async () => {
    await button("Move by hand", machinePanel()).click();
    close(await move(() => button("Right by 10 mm").click()), 10, 0);
    close(await move(() => button("Nearer and right by 10 mm").click()), 20, 10);
    await page.getByRole("radio", { name: "1 mm", exact: true }).check();
    close(await move(() => button("Left by 1 mm").click()), 19, 10);
    await button("Left by 1 mm").focus();
    close(await move(() => page.keyboard.press("ArrowDown")), 19, 11);
    close(await move(() => page.keyboard.press("ArrowRight")), 20, 11);
  });

  it("moves to a position, and makes it home", async () => {
    await page.getByLabel("From home, right").fill("50");
    await page.getByLabel("From home, down").fill("30");
    close(await move(() => button("Go there").click()), 50, 30);
    close(await move(() => button("Set home here").click()), 0, 0);
    close(await move(() => button("Right by 1 mm").click()), 1, 0);
    close(await move(() => button("Go home").click()), 0, 0);
  });

  it("traces the frame of the drawing, cycles the pen, and draws a test patch", async () => {
    for (const name of ["Trace the frame", "Cycle the pen", "Plot a test patch"]) {
      await move(() => button(name).click());
      expect((await plotter()).penUp).toBe(true);
    }
  });

  it("moves the pen to a height that the settings store", async () => {
    await move(() => button("Height down: a little higher").click());
    expect((await plotter()).penUp).toBe(false);
    await move(() => button("Pen up", machinePanel()).click());
  });

  it("is disabled while a job uses the plotter", async () => {
    await dropFile(page, "lines.svg", ruledSheet());
    await page.getByText("lines").first().waitFor();
    await waitForPlan(page);
    await button("Plot", plotBar(page)).click();
    await statusCard(page).getByRole("progressbar").waitFor();
    await openPanel(page, "Plotter");
    await page.getByText("You can move by hand again when it ends").waitFor();
    expect(await button(/^Right by/).isDisabled()).toBe(true);
    await button("Console", machinePanel()).click();
    await page.getByText("Commands sent now would spoil it").waitFor();
    expect(await page.getByLabel("Command", { exact: true }).count()).toBe(0);
    await page.keyboard.press("Escape");
    await button("Cancel", statusCard(page)).click();
    await button("Cancel the plot", page.getByRole("alertdialog")).click();
    await openPanel(page, "Queue");
    await historyPanel(page).getByText("Cancelled", { exact: true }).waitFor();
  });
});

describe("the console", () => {
  it("shows the board's reply, and brings earlier commands back", async () => {
    await openPanel(page, "Plotter");
    await button("Console", machinePanel()).click();
    const line = page.getByLabel("Command", { exact: true });
    await line.fill("V");
    await line.press("Enter");
    await page.getByRole("log").getByText(/EBBv/).waitFor();
    await line.press("ArrowUp");
    expect(await line.inputValue()).toBe("V");
    await page.keyboard.press("Escape");
  });
});

describe("setting a plotter up", () => {
  const wizard = (): Locator => page.getByRole("dialog", { name: "Set up a plotter" });
  const press = (name: string): Promise<void> => button(name, wizard()).click();

  it("no longer reports a stuck motor once the carriage went diagonally", async () => {
    await button("Set up a plotter…", machinePanel()).click();
    await press("Next");
    await press("It is in the middle");
    await press("Right");
    await press("Right");
    await wizard().getByRole("alert").getByText("one motor does not turn").waitFor();
    await press("Diagonally, between two of these");
    await wizard().getByRole("alert").waitFor({ state: "detached" });
    await page.keyboard.press("Escape");
  });

  it("makes a profile from the direction it moved, the measured square, and the pen's range", async () => {
    const homedWith: string[] = [];
    page.on("request", (request) => {
      if (request.method() !== "POST" || !request.url().endsWith("/set-home")) return;
      homedWith.push((request.postDataJSON() as { profile: { id: string } }).profile.id);
    });
    await button("Set up a plotter…", machinePanel()).click();
    await wizard().getByLabel("Most like").selectOption("axidraw-v3");
    await press("Next");
    await press("It is in the middle");
    close(await move(() => press("Move 20 mm to the right"), "/jog"), 20, 0);
    await press("Away from me");
    close(await move(() => press("Move 20 mm nearer"), "/jog"), 0, 20);
    await press("Left");
    close(await move(() => press("Right"), "/jog"), 20, 0);
    await press("Yes, both are right");
    close(await move(() => press("Set home here"), "/set-home"), 0, 0);
    // Home and moves use the same profile: another controller would connect again in between.
    expect(homedWith).toEqual(Array.from({ length: 5 }, () => "my-plotter"));
    await move(() => press("Draw the square"));
    await wizard().getByLabel("Measured width").fill("80");
    await wizard().getByLabel("Measured height").fill("80");
    await wizard().getByText("100 steps per mm").waitFor();
    await press("Use this");
    await wizard().getByRole("radio", { name: "B2 (brushless)" }).check();
    await move(() => wizard().getByLabel("Highest").fill("20000"));
    await move(() => wizard().getByLabel("Lowest").fill("12000"));
    await press("Next");
    await wizard().getByLabel("Name").fill("Old Friend");
    await wizard().getByLabel("Right", { exact: true }).fill("290");
    await press("Save and use");
    await wizard().waitFor({ state: "detached" });

    const { machines } = machineListSchema.parse(await (await fetch(`${server.url}/api/v1/machines`)).json());
    const made = machines.filter(({ builtIn }) => !builtIn);
    expect(made).toHaveLength(1);
    // Asked to go right it went away, asked to come nearer it went left: the axes are swapped and both are
    // reversed.
    expect(made[0]).toMatchObject({
      id: "old-friend",
      name: "Old Friend",
      stepsPerMm: 100,
      swapAxes: true,
      flipX: true,
      flipY: true,
      controller: {
        kind: "ebb",
        microstepMode: 1,
        servoPin: 5,
        servoPosAt0Pct: 12_000,
        servoPosAt100Pct: 20_000,
      },
      widthMm: 290,
    } satisfies Partial<MachineProfile>);
    await expect.poll(() => machinePanel().getByLabel("Model").inputValue()).toBe("old-friend");
  });

  it("plots with the new profile from then on", async () => {
    const sent = page.waitForRequest(
      (request) => request.method() === "POST" && request.url().endsWith("/jobs"),
    );
    await openView(page, "Prepare");
    await waitForPlan(page);
    await button("Add to queue", plotBar(page)).click();
    const body = (await sent).postDataJSON() as { settings: { customMachine: MachineProfile | null } };
    expect(body.settings.customMachine?.stepsPerMm).toBe(100);
    await openPanel(page, "Queue");
    await button(/^Start /, queuePanel(page)).waitFor();
  });
});

describe("machines as files", () => {
  it("are read, edited and stored", async () => {
    await openPanel(page, "Plotter");
    await button("Machines…", machinePanel()).click();
    const sheet = page.getByRole("dialog", { name: "Machines" });
    const profile = {
      id: "a-one",
      name: "A1 clone",
      widthMm: 840,
      heightMm: 594,
      stepsPerMm: 100,
      motors: "mixed",
      controller: {
        kind: "ebb",
        microstepMode: 1,
        servoPosAt0Pct: 8_000,
        servoPosAt100Pct: 26_000,
        servoPin: 4,
      },
    };
    const file = (content: unknown): { name: string; mimeType: string; buffer: Buffer } => ({
      name: "machine.json",
      mimeType: "application/json",
      buffer: Buffer.from(JSON.stringify(content)),
    });
    const chooser = sheet.getByLabel("Load a machine from a file");
    await chooser.setInputFiles(file({ ...profile, stepsPerMm: -1 }));
    await sheet.getByText(/stepsPerMm/).waitFor();
    // Empty again: the browser reports a file that is chosen again, after it was edited, only then.
    expect(await chooser.inputValue()).toBe("");
    await chooser.setInputFiles(file(profile));
    await sheet.getByLabel("Steps per mm").fill("120");
    // In sight on a phone too, where the form is longer than the screen.
    await page.setViewportSize({ width: 390, height: 844 });
    const [inForm, save] = [await sheet.boundingBox(), await button("Save and use", sheet).boundingBox()];
    expect(save!.y + save!.height).toBeLessThanOrEqual(inForm!.y + inForm!.height);
    await page.setViewportSize({ width: 900, height: 600 });
    await button("Save and use", sheet).click();
    await button("Edit A1 clone", sheet).waitFor();
    const download = page.waitForEvent("download");
    await button("Save A1 clone as a file", sheet).click();
    expect((await download).suggestedFilename()).toBe("a-one.json");
    await button("Remove A1 clone", sheet).click();
    await button("Edit A1 clone", sheet).waitFor({ state: "detached" });
    await page.keyboard.press("Escape");
  });
});

describe("the profile of a Grbl machine", () => {
  it("is edited and stored: how the pen is lifted, its values, and what may be left out", async () => {
    await openPanel(page, "Plotter");
    await button("Machines…", machinePanel()).click();
    const sheet = page.getByRole("dialog", { name: "Machines" });
    await button("Copy Plotter with Grbl and a Z axis to a new machine", sheet).click();
    await sheet.getByLabel("Name", { exact: true }).fill("My Z");
    await sheet.getByLabel("Z with the pen up", { exact: true }).fill("7");
    await sheet.getByRole("switch", { name: "Set: Wait for the pen" }).setChecked(true);
    await sheet.getByLabel("Wait for the pen", { exact: true }).fill("150");
    const saved = async (): Promise<Record<string, unknown> | undefined> => {
      await button("Save and use", sheet).click();
      await button("Edit My Z", sheet).waitFor();
      const { machines } = machineListSchema.parse(
        await (await fetch(`${server.url}/api/v1/machines`)).json(),
      );
      return machines.find(({ name }) => name === "My Z")?.controller;
    };
    expect(await saved()).toMatchObject({ kind: "grbl", penUpZMm: 7, penDownZMm: 0, penWaitMs: 150 });

    await button("Edit My Z", sheet).click();
    await sheet.getByRole("radio", { name: "Servo (M3 S)" }).check();
    await sheet.getByLabel("S with the pen up", { exact: true }).fill("480");
    expect(await sheet.getByLabel("Z with the pen up", { exact: true }).count()).toBe(0);
    expect(await saved()).toMatchObject({ penUpS: 480, penDownS: 300, penUpZMm: null, penDownZMm: null });

    await button("Edit My Z", sheet).click();
    await sheet.getByRole("radio", { name: "Own lines" }).check();
    await sheet.getByLabel("Lines that lift the pen", { exact: true }).fill("M3 S90\nG4 P0.2");
    await sheet.getByLabel("Lines that lower the pen", { exact: true }).fill("M5");
    expect(await saved()).toMatchObject({ penUpLines: "M3 S90\nG4 P0.2", penUpS: null });
    await button("Remove My Z", sheet).click();
    await button("Edit My Z", sheet).waitFor({ state: "detached" });
    await page.keyboard.press("Escape");
  });
});

describe("the name of a plotter", () => {
  it("a plotter's name that was changed elsewhere is shown in its field, which does not change it back", async () => {
    await button("Sharing, plotters, camera").click();
    const sheet = page.getByRole("dialog", { name: "Sharing" });
    await sheet.getByRole("radio", { name: "Plotters" }).check();
    const field = sheet.getByRole("textbox", { name: /^Name of (?!the plotter)/ });
    const { id } = await plotter();
    const rename = await page.request.patch(`${server.url}/api/v1/plotters/${id}`, {
      data: { name: "Desk" },
    });
    expect(rename.status()).toBe(200);
    await expect.poll(() => field.inputValue()).toBe("Desk");
    await field.focus();
    await field.blur();
    await field.fill(" ");
    await field.blur();
    expect(await field.inputValue()).toBe("Desk");
    await field.fill("Window");
    await field.press("Enter");
    await expect.poll(async () => (await plotter()).name).toBe("Window");
    await page.keyboard.press("Escape");
  });
});
