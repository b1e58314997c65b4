/** Errors of a schema are reported in plain words, never in those of the schema library. */
import { describe, expect, it } from "vitest";
import { z } from "zod";
import {
  faultInWords,
  firstFault,
  machineProfileSchema,
  plotSettingsSchema,
} from "../../../src/schema/index.js";

const fault = (schema: z.ZodType, value: unknown): string => {
  const result = schema.safeParse(value);
  if (result.success) throw new Error("it was accepted");
  return faultInWords(result.error.issues[0]);
};

describe("the words for a fault", () => {
  it.each([
    [z.object({ a: z.string() }), {}, "it is missing"],
    [z.string(), 3, "it must be text"],
    [z.int(), 1.5, "it must be a whole number"],
    [z.boolean(), "yes", "it must be true or false"],
    [z.array(z.number()), {}, "it must be a list"],
    [z.enum(["mixed", "direct"]), "both", "it must be one of mixed, direct"],
    [z.literal(2), 3, "it must be 2"],
    [z.number().max(1000), 2000, "it must be at most 1000"],
    [z.number().gt(0), 0, "it must be more than 0"],
    [z.string().min(1), "", "it must have at least 1 character"],
    [z.array(z.number()).max(2), [1, 2, 3], "it must have at most 2 entries"],
    [z.strictObject({}), { x: 1 }, "there is no x"],
    [z.union([z.literal(0), z.literal(1)]), 2, "it has a form that is not allowed here"],
    [z.number({ error: "it must be a weight" }), "3", "it must be a weight"],
  ])("%#", (schema, value, words) => {
    expect(fault(schema, value)).toBe(words);
  });

  it("name the field in settings and in profiles", () => {
    const settings = plotSettingsSchema.safeParse({ motion: { maxSpeed: "fast" } });
    const profile = machineProfileSchema.safeParse({ id: "x" });
    expect(firstFault(settings.error!)).toEqual({
      path: expect.any(String),
      words: expect.stringMatching(/^it /),
    });
    expect(firstFault(profile.error!)).toEqual({ path: "name", words: "it is missing" });
  });
});
