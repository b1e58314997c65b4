/** The stored drawings of the page without a server, in a browser whose storage fails. */
import { describe, expect, it } from "vitest";
import { drawingRecords, MemoryRecords } from "../../../../web/backend/browser/drawing-records.js";

/** Stores drawings, but reports that the changes since then could not be stored. */
class FullRecords extends MemoryRecords {
  isFull = false;

  override written(): Promise<void> {
    return this.isFull ? Promise.reject(new DOMException("", "QuotaExceededError")) : super.written();
  }
}

describe("the stored drawings", () => {
  it("can be read and removed while changes can't be stored, so that a plot can start", async () => {
    const db = new FullRecords();
    const drawings = drawingRecords(db);
    const id = await drawings.add("<svg/>");
    db.isFull = true;
    expect(await drawings.read(id)).toBe("<svg/>");
    await drawings.remove(id);
    await expect(drawings.read(id)).rejects.toMatchObject({ code: "bad-file" });
  });

  it("are not kept if there is no room for them", async () => {
    const db = new FullRecords();
    db.isFull = true;
    await expect(drawingRecords(db).add("<svg/>")).rejects.toMatchObject({
      code: "disk-full",
      message: expect.stringContaining("storage for this site is full") as string,
    });
    expect(await db.drawingIds()).toEqual([]);
  });

  it("stored drawings that can't be read are reported in words", async () => {
    const db = new MemoryRecords();
    db.readDrawing = () => Promise.reject(new DOMException("Internal error.", "UnknownError"));
    await expect(drawingRecords(db).read("a")).rejects.toMatchObject({
      code: "bad-file",
      message: "The browser can’t read this drawing: its storage for this site reports “Internal error.”.",
    });
  });
});
