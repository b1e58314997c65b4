/** A plot beside a camera: where a step back leads is marked before it is made, and the pictures are played at the end. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { cameraStateSchema, keptPicturesSchema, type Job } from "../../../src/schema/index.js";
import { seriousFindings } from "../../support/browser/axe.js";
import { BLUE, fakeCamera, RED, still, type FakeCamera } from "../../support/camera/fake-camera.js";
import { openPanel, plotBar, statusCard } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

const PATIENCE_MS = 120_000;
const NAME = "rows";
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="80mm" viewBox="0 0 120 80" fill="none" stroke="#c00">${Array.from(
  { length: 12 },
  (_, i) => `<path d="M10 ${10 + 5 * i}h100"/>`,
).join("")}</svg>`;

let test: PageTest;
let camera: FakeCamera;

beforeAll(async () => {
  camera = await fakeCamera({
    "/snapshot.jpg": (response, request, count) =>
      count === 4
        ? void response.writeHead(500).end()
        : still(count < 3 ? RED : BLUE)(response, request, count),
  });
  test = await PageTest.firstVisit("filmed", {}, ["--virtual-speed", "2"]);
}, PATIENCE_MS);

afterAll(async () => {
  await test.close();
  await camera.close();
});

const theJob = async (): Promise<Job> => (await test.jobs()).find(({ name }) => name === NAME)!;
const lapse = () => test.page.getByRole("region", { name: "Timelapse" });
const kept = async (): Promise<number> => {
  const { id } = await theJob();
  const answer = await test.page.request.get(`${test.server.url}/api/v1/jobs/${id}/pictures`);
  return keptPicturesSchema.parse(await answer.json()).pictures.length;
};

/** The middle of the mark on the sheet, CSS px; null: there is none. */
const mark = (): Promise<readonly [x: number, y: number] | null> =>
  test.page.evaluate(() => {
    for (const canvas of document.querySelectorAll<HTMLCanvasElement>("[aria-label='Sheet'] canvas")) {
      const context = canvas.getContext("2d");
      if (!context || canvas.width === 0) continue;
      const { data, width } = context.getImageData(0, 0, canvas.width, canvas.height);
      let [count, sumX, sumY] = [0, 0, 0];
      for (let i = 0; i < data.length; i += 4) {
        if (data[i] !== 20 || data[i + 1] !== 80 || data[i + 2] !== 255) continue;
        count++;
        sumX += (i / 4) % width;
        sumY += Math.floor(i / 4 / width);
      }
      if (count > 20) return [sumX / count, sumY / count] as const;
    }
    return null;
  });

const apart = (a: readonly [number, number], b: readonly [number, number]): number =>
  Math.hypot(a[0] - b[0], a[1] - b[1]);
/** The mark once it stays where it is. */
const restingMark = async (): Promise<readonly [number, number]> => {
  let [before, now] = [await mark(), await mark()];
  await expect
    .poll(async () => {
      [before, now] = [now, await mark()];
      return before && now ? apart(before, now) : Infinity;
    })
    .toBeLessThan(0.5);
  return now!;
};
const moved = async (from: readonly [number, number]): Promise<readonly [number, number]> => {
  await expect.poll(async () => apart((await mark()) ?? from, from)).toBeGreaterThan(3);
  return restingMark();
};

describe("a plot beside a camera", () => {
  it("has a camera that the sharing dialog sets and tries", async () => {
    const { page } = test;
    await page.getByRole("button", { name: "Sharing, plotters, camera" }).click();
    await page.getByRole("radio", { name: "Camera" }).check();
    const address = page.getByLabel("Address that the server reads");
    await address.fill(`${camera.url}/nothing`);
    await page.getByRole("button", { name: "Keep pictures" }).click();
    await page.getByText("The camera answers with HTTP 404.").waitFor();
    await address.fill(`${camera.url}/snapshot.jpg`);
    await page.getByLabel("A picture every").selectOption("2");
    await page.getByRole("button", { name: "Keep pictures" }).click();
    await page.getByText("The camera works.").waitFor();
    expect(await seriousFindings(page)).toEqual([]);
    const plotter = (await (await page.request.get(`${test.server.url}/api/v1/state`)).json()) as {
      plotters: { id: string }[];
    };
    const path = `/api/v1/plotters/${plotter.plotters[0].id}/camera`;
    const { camera: stored } = cameraStateSchema.parse(
      await (await page.request.get(test.server.url + path)).json(),
    );
    expect(stored).toEqual({ url: `${camera.url}/snapshot.jpg`, everyS: 2 });
    await page.keyboard.press("Escape");
    await page.getByRole("dialog").waitFor({ state: "detached" });
  });

  it("marks where one stroke back leads, and another step while its button is pointed at or has the focus", async () => {
    const { page } = test;
    await test.drop(NAME, SVG);
    await plotBar(page).getByRole("button", { name: "Plot", exact: true }).click();
    await expect.poll(async () => (await theJob()).progress).toBeGreaterThan(0.2);
    await statusCard(page).getByRole("button", { name: "Pause" }).click();
    await expect.poll(async () => (await theJob()).state).toBe("paused");
    await openPanel(page, "Queue");
    const button = (name: string) => page.getByRole("button", { name, exact: true });
    // So that a step of 10 mm back stays on its stroke.
    await expect
      .poll(async () => {
        if ((await theJob()).place!.alongMm <= 15) await button("10 mm forward").click();
        return (await theJob()).place!.alongMm;
      })
      .toBeGreaterThan(15);
    const { alongMm } = (await theJob()).place!;
    await page.mouse.move(5, 5);
    // Nothing is pointed at, as on a touch screen.
    const begin = await restingMark();
    await page.getByText("The ring on the sheet marks where “One stroke back” leads.").waitFor();
    const pointAt = async (name: string): Promise<readonly [number, number]> => {
      await page.mouse.move(5, 5);
      await button(name).blur();
      const rest = await restingMark();
      await button(name).hover();
      return moved(rest);
    };
    const here = await pointAt("Go there with the pen up");
    const near = await pointAt("10 mm back");
    // The mark is painted on whole pixels.
    expect(Math.abs(apart(begin, here) / apart(near, here) / (alongMm / 10) - 1)).toBeLessThan(0.1);
    // On a turned desk, the stroke and the mark's way along it are turned too.
    const turn = page.getByRole("button", { name: "Turn the desk" });
    await turn.click();
    const turnedHere = await pointAt("Go there with the pen up");
    const turnedNear = await pointAt("10 mm back");
    const [dx, dy] = [near[0] - here[0], near[1] - here[1]];
    const [turnedX, turnedY] = [turnedNear[0] - turnedHere[0], turnedNear[1] - turnedHere[1]];
    const angleDeg = (Math.atan2(dx * turnedY - dy * turnedX, dx * turnedX + dy * turnedY) * 180) / Math.PI;
    expect(Math.abs(angleDeg - 90)).toBeLessThan(5);
    for (let quarter = 1; quarter < 4; quarter++) await turn.click();
    // Nothing has moved.
    expect((await theJob()).place!.alongMm).toBe(alongMm);
    await page.mouse.move(5, 5);
    const rest = await restingMark();
    await button("10 mm back").focus();
    expect(apart(await moved(rest), near)).toBeLessThan(3);
    await button("One stroke back").focus();
    const atBegin = await moved(near);
    expect(apart(atBegin, begin)).toBeLessThan(3);
    await page.keyboard.press("Enter");
    await expect.poll(async () => (await theJob()).place!.alongMm).toBe(0);
    // From there it leads to the stroke before.
    await moved(begin);
  });

  it(
    "shows no timelapse before it is done, and then plays the pictures from the first to the last",
    async () => {
      const { page } = test;
      expect(await lapse().count()).toBe(0);
      await statusCard(page).getByRole("button", { name: "Resume" }).click();
      await expect.poll(mark).toBeNull();
      await expect.poll(async () => (await theJob()).state, { timeout: PATIENCE_MS }).toBe("done");
      await lapse().getByRole("img").waitFor();
      await expect.poll(kept).toBeGreaterThan(2);
      const size = await lapse()
        .getByRole("img")
        .evaluate(async (image: HTMLImageElement) => {
          await image.decode();
          return [image.naturalWidth, image.naturalHeight];
        });
      expect(size).toEqual([16, 12]);
      expect(await seriousFindings(page)).toEqual([]);
      const number = async (): Promise<number> =>
        Number(/Picture (\d+) of/.exec((await lapse().getByRole("img").getAttribute("alt")) ?? "")?.[1]);
      await lapse().getByRole("slider", { name: "Moment of the timelapse" }).fill("0");
      await expect.poll(number).toBe(1);
      await lapse().getByRole("button", { name: "Play the timelapse" }).click();
      await expect.poll(number).toBeGreaterThan(2);
      await lapse().getByRole("button", { name: "Play the timelapse" }).waitFor();
      await lapse().getByText("1 picture is missing.").waitFor();
    },
    2 * PATIENCE_MS,
  );

  it("plays on past pictures that the page can't get or show, counts them, and tries them again", async () => {
    const { page } = test;
    const { id } = await theJob();
    const answer = await page.request.get(`${test.server.url}/api/v1/jobs/${id}/pictures`);
    const { pictures } = keptPicturesSchema.parse(await answer.json());
    expect(pictures.length).toBeGreaterThan(4);
    const [, gone, noPicture, halfPicture] = pictures.map(({ at }) => encodeURIComponent(at));
    const asked: string[] = [];
    let isBroken = true;
    await page.route(/\/picture\?at=/, (route) => {
      const url = route.request().url();
      asked.push(url);
      if (isBroken && url.includes(gone)) return route.fulfill({ status: 500, body: "{}" });
      if (isBroken && url.includes(noPicture)) return route.fulfill({ body: "<html>not a picture</html>" });
      if (isBroken && url.includes(halfPicture)) return route.fulfill({ body: RED.subarray(0, 40) });
      return route.continue();
    });
    await page.reload();
    await openPanel(page, "Queue");
    await page.getByRole("button", { name: `Show ${NAME} as it was plotted` }).click();
    await lapse().getByText("1 picture is missing.").waitFor();
    const play = lapse().getByRole("button", { name: "Play the timelapse" });
    const moment = lapse().getByRole("slider", { name: "Moment of the timelapse" });
    await play.click();
    await lapse().getByText("4 pictures are missing.").waitFor();
    await expect.poll(() => moment.inputValue()).toBe(String(pictures.length - 1));
    await play.waitFor();
    await moment.fill("1");
    await lapse().getByText("This picture is missing.").waitFor();
    expect(asked.filter((url) => url.includes(gone)).length).toBeLessThanOrEqual(4);
    expect(await seriousFindings(page)).toEqual([]);
    isBroken = false;
    await play.click();
    await lapse().getByText("1 picture is missing.").waitFor();
    await expect.poll(() => moment.inputValue()).toBe(String(pictures.length - 1));
    await page.unroute(/\/picture\?at=/);
    // The browser itself reports the answer 500.
    expect(test.complaints.splice(0).filter((line) => !line.includes("500"))).toEqual([]);
  });

  it("is forgotten with its job", async () => {
    const { id } = await theJob();
    const api = `${test.server.url}/api/v1/jobs/${id}`;
    expect((await test.page.request.delete(api)).ok()).toBe(true);
    expect((await test.page.request.get(`${api}/pictures`)).status()).toBe(404);
    await expect.poll(() => lapse().count()).toBe(0);
  });

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});
