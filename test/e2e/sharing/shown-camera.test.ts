/** The camera beside the plotter whose picture the page shows. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { PageTest } from "../../support/browser/page-test.js";

const ADDRESS = "http://camera.test/stream";

let test: PageTest;
beforeAll(async () => {
  test = await PageTest.firstVisit("shown-camera");
});
afterAll(async () => test.close());

describe("a camera that does not answer", () => {
  it("is said to have no picture, without the browser's broken one", async () => {
    const { page } = test;
    await page.route(`${ADDRESS}**`, () => undefined);
    await page.getByRole("button", { name: "Sharing, plotters, camera" }).click();
    const sharing = page.getByRole("dialog", { name: "Sharing" });
    await sharing.getByRole("radio", { name: "Camera" }).check();
    await sharing.getByRole("textbox").first().fill(ADDRESS);
    await sharing.getByRole("button", { name: "Show", exact: true }).click();
    await page.keyboard.press("Escape");
    await test.panel("Plotter");
    const camera = page.getByRole("region", { name: "Camera" });
    await camera.getByText("No picture from the camera", { exact: false }).waitFor();
    expect((await camera.getByRole("img").boundingBox())!.height).toBeLessThan(2);
  });
});
