/** The first minutes with a new plotter: which one it is, home, and the way back after a lost position. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { snapshotSchema, type Plotter } from "../../../src/schema/index.js";
import { PageTest } from "../../support/browser/page-test.js";

let test: PageTest;
beforeAll(async () => {
  test = await PageTest.firstVisit("first-steps");
});
afterAll(() => test.close());

const guide = () => test.page.getByRole("region", { name: "First plot with this plotter" });
const press = (name: string) =>
  guide().getByRole("button", { name, exact: true }).and(test.page.locator(":enabled")).click();
const plotter = async (): Promise<Plotter> =>
  snapshotSchema.parse(await (await fetch(`${test.server.url}/api/v1/state`)).json()).plotters[0];

describe("the first steps", () => {
  it("begin with the question which plotter this is, and store the answer, also if it is the shown one", async () => {
    expect((await plotter()).machine).toBeNull();
    const question = guide().getByRole("group", { name: "Which plotter is this?" });
    await question.waitFor();
    expect(await guide().locator("li").first().innerText()).toContain("Which plotter is this?");
    await guide().getByLabel("All models").selectOption({ label: "AxiDraw V3" });
    await expect.poll(async () => (await plotter()).machine).toBe("axidraw-v3");
    await guide().getByText("Push the carriage by hand into its home corner", { exact: false }).waitFor();
  });

  it("let a NextDraw find home by itself: one choice, one click", async () => {
    await press("Another model…");
    await press("NextDraw 8511");
    await expect.poll(async () => (await plotter()).machine).toBe("nextdraw-8511");
    await guide().getByText("Clear its way. Home finds the corner.").waitFor();
    await press("Home");
    await guide().getByText("The carriage is home.").waitFor();
    await expect
      .poll(async () => {
        const { connection, xMm, yMm, penUp } = await plotter();
        return { connection, xMm, yMm, penUp };
      })
      .toEqual({ connection: "idle", xMm: 0, yMm: 0, penUp: true });
  });

  it("log no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});
