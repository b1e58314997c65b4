import { describe, expect, it } from "vitest";
import { placeAfterMove, slotOfDrop } from "../../../web/ui/rows/row-drag.js";

/** The server's result for "put id before that one". */
const moved = (ids: readonly string[], id: string, beforeId: string | null): string[] => {
  const others = ids.filter((other) => other !== id);
  const at = beforeId === null ? others.length : others.indexOf(beforeId);
  return [...others.slice(0, at), id, ...others.slice(at)];
};

describe("a row of the queue", () => {
  const ids = ["a", "b", "c", "d"];

  it("reaches every place it is moved to", () => {
    for (const id of ids) {
      for (let place = 0; place < ids.length; place++) {
        const beforeId = placeAfterMove(ids, id, place);
        if (ids[place] === id) expect(beforeId).toBeUndefined();
        else expect(moved(ids, id, beforeId!).indexOf(id)).toBe(place);
      }
    }
  });

  it("is not moved beyond the ends", () => {
    expect(placeAfterMove(ids, "a", -1)).toBeUndefined();
    expect(placeAfterMove(ids, "d", 4)).toBeUndefined();
  });

  it("a row that is dropped between two others lands between them", () => {
    expect(slotOfDrop([10, 30, 50], 0)).toBe(0);
    expect(slotOfDrop([10, 30, 50], 40)).toBe(2);
    expect(slotOfDrop([10, 30, 50], 90)).toBe(3);
  });
});
