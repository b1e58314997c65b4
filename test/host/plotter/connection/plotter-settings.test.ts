/** Heights, pens and presets of each plotter: stored by the server, the same for every browser. */
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { prepareDataDir } from "../../../../server/storage/data-dir.js";
import { Store } from "../../../../server/storage/store.js";
import {
  apiErrorSchema,
  DEFAULT_PLOT_SETTINGS,
  plotterPartOf,
  plotterSchema,
  plotterSettingsSchema,
  snapshotSchema,
  withPlotterPart,
  type PlotterSettings,
} from "../../../../src/schema/index.js";
import { startApp, type TestApp } from "../../../support/servers/app.js";
import { EventStream } from "../../../support/servers/event-stream.js";
import { folderOfTest } from "../../../support/processes/folders.js";

const PEN = { id: "pen-1", name: "Red", color: "#ff0000", widthMm: 0.4, offsetXMm: 0, offsetYMm: 0 };
const settingsWith = (upPct: number): PlotterSettings => {
  const { pen } = plotterPartOf(DEFAULT_PLOT_SETTINGS);
  return plotterSettingsSchema.parse({ pen: { ...pen, upPct }, pens: [PEN], presets: [] });
};

describe("the settings of a plotter", () => {
  let app: TestApp;
  beforeEach(async () => {
    app = await startApp();
  });
  afterEach(() => app.close());

  const call = (method: string, path: string, body?: unknown): Promise<Response> =>
    fetch(`${app.url}/api/v1${path}`, {
      method,
      ...(body === undefined
        ? {}
        : { body: JSON.stringify(body), headers: { "Content-Type": "application/json" } }),
    });
  const stored = async (id: string): Promise<unknown> =>
    (await call("GET", `/plotters/${id}/settings`)).json();

  it("are null until a client sets them, then the same for all clients", async () => {
    expect(await stored("virtual")).toBeNull();
    const events = await EventStream.open(app.url);
    const wanted = settingsWith(72);
    const response = await call("PUT", "/plotters/virtual/settings", wanted);
    expect([response.status, await response.json()]).toEqual([200, wanted]);
    const event = await events.find("plotter-settings", () => true);
    expect(event).toMatchObject({ plotterId: "virtual", settings: wanted });
    events.close();
    expect(await stored("virtual")).toEqual(wanted);
    const state = snapshotSchema.parse(await (await call("GET", "/state")).json());
    expect(state.plotterSettings).toEqual({ virtual: wanted });
  });

  it("are each plotter's own, stay through a change of its name, and go with it", async () => {
    const added = await call("POST", "/plotters", { name: "Upstairs", device: "virtual" });
    const { id } = plotterSchema.parse(await added.json());
    await call("PUT", "/plotters/virtual/settings", settingsWith(72));
    await call("PUT", `/plotters/${id}/settings`, settingsWith(55));
    await call("PATCH", `/plotters/${id}`, { name: "Attic" });
    expect([await stored("virtual"), await stored(id)]).toEqual([settingsWith(72), settingsWith(55)]);
    await call("DELETE", `/plotters/${id}`);
    expect(Object.keys(app.store.plotterSettings())).toEqual(["virtual"]);
  });

  it("are refused if they are invalid, and for a missing plotter", async () => {
    const wrong = { ...settingsWith(72), pen: { ...settingsWith(72).pen, upPct: 130 } };
    const refused = await call("PUT", "/plotters/virtual/settings", wrong);
    expect(refused.status).toBe(400);
    expect(apiErrorSchema.parse(await refused.json()).error.message).toMatch(/pen\.upPct/);
    expect((await call("PUT", "/plotters/no-one/settings", settingsWith(72))).status).toBe(404);
    expect((await call("GET", "/plotters/no-one/settings")).status).toBe(404);
    expect(app.store.plotterSettings()).toEqual({});
  });

  it("settings of a plotter that can't be read count as missing", async () => {
    app.store.savePlotterSettings("virtual", { pen: "tall" });
    expect(await stored("virtual")).toBeNull();
    expect((await call("PUT", "/plotters/virtual/settings", settingsWith(61))).status).toBe(200);
  });
});

describe("in a drawing's settings", () => {
  it("the plotter's part replaces heights and pens, but no layer's own, nor a pen that a layer uses", () => {
    const own = { ...PEN, id: "pen-9", name: "Gold" };
    const unused = { ...PEN, id: "pen-8" };
    const drawing = {
      ...DEFAULT_PLOT_SETTINGS,
      pen: { ...DEFAULT_PLOT_SETTINGS.pen, upPct: 99, layers: { sky: { downPct: 20 } } },
      pens: [own, unused],
      layerPens: { sky: "pen-9" },
    };
    const merged = withPlotterPart(drawing, settingsWith(72));
    expect(merged.pen).toEqual({ ...settingsWith(72).pen, layers: { sky: { downPct: 20 } } });
    expect(merged.pens).toEqual([PEN, own]);
    expect(plotterPartOf(merged).pen).toEqual(settingsWith(72).pen);
  });
});

describe("a plotter's settings in the database", () => {
  it("are there again after a restart", () => {
    const dir = folderOfTest();
    prepareDataDir(dir);
    const store = Store.open(dir);
    store.savePlotter({ id: "main", name: "Desk", device: "auto", machine: "axidraw-se-a3" });
    expect(store.plotterSettings()).toEqual({});
    store.savePlotterSettings("main", settingsWith(72));
    store.close();
    const again = Store.open(dir);
    expect(again.plotterSettings()).toEqual({ main: settingsWith(72) });
    again.close();
  });
});
