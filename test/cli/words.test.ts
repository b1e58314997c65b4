/** What people type: a word that is not a command, and lengths with units. */
import { describe, expect, it } from "vitest";
import { length, sizeMm } from "../../server/cli/lengths.js";
import { settingsFromOptions } from "../../server/cli/settings-options.js";
import { SETTING_OPTIONS } from "../../server/cli/setting-table.js";
import { cli } from "./support.js";

describe("a word that is not a command", () => {
  it.each([
    ["pln", "x.svg", /There is no command pln\. The commands are serve, plan, plot, /],
    ["recover", "", /There is no command recover\. The commands are /],
    ["x.svg", "", /There is no command x\.svg\. To plot a drawing: plotwright plot x\.svg$/],
    ["9381", "", /To choose the port: plotwright --port 9381, or npm start -- --port 9381/],
  ])("%s %s is named, with a suggestion", async (word, more, message) => {
    const { code, out, err } = await cli(...[word, more].filter((one) => one !== ""));
    expect([code, out]).toEqual([2, ""]);
    expect(err.trim()).toMatch(message);
    expect(err.trim().split("\n")).toHaveLength(1);
  });

  it("leaves options and help unchanged", async () => {
    expect(await cli("--version")).toMatchObject({ code: 0, out: "0.0.0\n" });
    expect((await cli("help")).code).toBe(0);
    expect((await cli("--nonsense")).err).toMatch(/unknown option/);
  });
});

describe("a length", () => {
  it("is mm, or has a unit", () => {
    const read = ["12", "12mm", "1.2cm", "1in", '1"', ".5in", "-3", "2 cm"].map(length);
    expect(read).toEqual([12, 12, 12, 25.4, 25.4, 12.7, -3, 20]);
    for (const wrong of ["", "x", "1ft", "1 2", "in", "1e999", "1,5"]) {
      expect(() => length(wrong)).toThrow(/a length in mm, or with a unit/);
    }
  });

  it("of a sheet has a unit for both sides or for each", () => {
    expect(sizeMm("210x297")).toEqual({ widthMm: 210, heightMm: 297 });
    expect(sizeMm("20x20cm")).toEqual({ widthMm: 200, heightMm: 200 });
    expect(sizeMm("8.5x11in")).toEqual({ widthMm: 215.9, heightMm: 279.4 });
    expect(sizeMm("8.5in × 279.4mm")).toEqual({ widthMm: 215.9, heightMm: 279.4 });
    for (const wrong of ["", "x", "1x", "1x2x3", "0x5", "-1x5", "1x1ft"]) expect(sizeMm(wrong)).toBeNull();
  });

  it("may be given to every option that takes mm", () => {
    for (const { flags, parse } of SETTING_OPTIONS) {
      if (/<mm>/.test(flags)) expect([flags, parse?.("1in")]).toEqual([flags, 25.4]);
    }
    const paper = SETTING_OPTIONS.find(({ flags }) => flags.startsWith("--paper"))?.parse?.("8.5x11in");
    expect(settingsFromOptions({ paper }).prepare).toMatchObject({
      paper: { widthMm: 215.9, heightMm: 279.4 },
      landscape: false,
    });
  });
});
