/** A plotter whose port the server does not know: the page asks what is on the ports, and the user takes one. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { machineById } from "../../../src/index.js";
import { snapshotSchema, type AskedDevice, type Plotter } from "../../../src/schema/index.js";
import { PageTest } from "../../support/browser/page-test.js";
import { PtyGrbl } from "../../support/processes/pty-grbl.js";

describe("a Grbl on a port that is not chosen yet", () => {
  let board: PtyGrbl;
  let test: PageTest;
  beforeAll(async () => {
    board = await PtyGrbl.open({ machine: machineById("idraw-h-a3"), face: "DrawCore", speed: 10 });
    test = await PageTest.firstVisit("find-plotter");
    // A pseudo-terminal has no USB chip, so the server can't find it by itself.
    const device = { description: "USB device", inUseBy: null, fault: null };
    const devices: AskedDevice[] = [
      { ...device, path: "/dev/ttyUSB7", answer: null },
      { ...device, path: "/dev/ttyUSB8", answer: null, fault: "Another program is using /dev/ttyUSB8." },
      { ...device, path: board.path, answer: "DrawCore 2.09" },
    ];
    await test.page.route("**/api/v1/devices/ask", (route) => route.fulfill({ json: { devices } }));
  });
  afterAll(async () => {
    await test.close();
    await board.close();
  });

  const panel = () => test.page.getByRole("region", { name: "Plotter", exact: true });
  const panelOf = (title: string) => test.page.getByRole("button", { name: new RegExp(`^${title}`) });
  const find = () => panel().getByRole("button", { name: "Find plotter" });
  const plotter = async (): Promise<Plotter> =>
    snapshotSchema.parse(await (await fetch(`${test.server.url}/api/v1/state`)).json()).plotters[0];

  const bottomOf = async (label: string): Promise<number> => {
    const { y, height } = (await test.page.getByLabel(label).boundingBox())!;
    return y + height;
  };

  it("is offered beside the ports where nothing answers", async () => {
    await find().click();
    const ports = panel().getByRole("list", { name: "What is on the ports" });
    await ports.waitFor();
    expect(await ports.getByRole("listitem").allInnerTexts()).toEqual([
      "No answer\n/dev/ttyUSB7",
      "No answer\nAnother program is using /dev/ttyUSB8.",
      `DrawCore 2.09\n${board.path}\nUse`,
    ]);
    expect(await ports.getByRole("button").count()).toBe(1);
  });

  it("is taken, and named while the model is that of another controller", async () => {
    await panel()
      .getByRole("button", { name: `Use the DrawCore 2.09 at ${board.path}` })
      .click();
    await panel().getByText("DrawCore 2.09 answers on this port").waitFor();
    expect((await plotter()).device).toBe(board.path);
  });

  it("is connected when its model is chosen, and no longer sought", async () => {
    const fitting = panel().getByRole("group", { name: "Models for the DrawCore 2.09" });
    await fitting.getByRole("button", { name: "iDraw H A3" }).click();
    await expect.poll(plotter, { timeout: 20_000 }).toMatchObject({
      connection: "idle",
      machine: "idraw-h-a3",
      firmware: "DrawCore 2.09",
    });
    await find().waitFor({ state: "detached" });
  });

  it("is not offered what its controller does not do, and the console's examples are its own", async () => {
    const { page } = test;
    await panelOf("Lifting the pen").click();
    // In one row, although their labels have different lengths.
    const [lift, drop] = [
      await bottomOf("Extra wait after lifting"),
      await bottomOf("Extra wait after lowering"),
    ];
    expect(lift).toBe(drop);
    expect(await page.getByText("Move while the pen lifts").count()).toBe(0);
    expect(await page.getByText("Lower the pen gently").count()).toBe(0);
    await page.getByRole("button", { name: "Hide these steps" }).click();
    await page.getByRole("button", { name: "Draw a test line" }).waitFor();
    expect(await page.getByText("Tip touches at").count()).toBe(0);
    await page.getByRole("button", { name: "Console" }).click();
    const dialog = page.getByRole("dialog", { name: "Console of Plotter" });
    await dialog.getByPlaceholder("$$", { exact: true }).waitFor();
    await page.keyboard.press("Escape");
    await test.panel("Speed");
    await test.group("Speed", "Details");
    await page.getByText("This plotter’s controller plans the motion by itself").waitFor();
    await page.getByRole("group", { name: "Pen down" }).getByLabel("Speed").first().waitFor();
    expect(await page.getByLabel("Acceleration").count()).toBe(0);
    await page.getByRole("group", { name: "Limits of one axis" }).getByText("Speed along x").waitFor();
    expect(await page.getByText("Acceleration along x").count()).toBe(0);
    expect(await page.getByText("Motion sent ahead").count()).toBe(0);
    expect(test.complaints).toEqual([]);
  });
});
