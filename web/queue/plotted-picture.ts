/** A finished plot as a picture: every stroke where it was drawn, in the pens' colours and widths. */
import type { Job } from "../../src/schema/index.js";
import type { Backend } from "../backend/backend.js";
import { saveFile } from "../ui/files/save-file.js";
import { drawnSvg } from "../worker/drawn-svg.js";

export type PictureFormat = "png" | "svg";

/** Longer side of a PNG: sharp on a screen, and when printed as large as a postcard. */
const PNG_PX = 3_000;
const PAPER = "#ffffff";

/** Plans the job once more, and saves what it drew. Rejects with a message for the user. */
export const savePicture = async (backend: Backend, job: Job, format: PictureFormat): Promise<void> => {
  const text = await backend.jobs.drawing(job.id);
  const svg = await drawnSvg({ key: job.id, text }, job.settings);
  const name = `${job.name.replace(/\.\w{1,5}$/, "")}, plotted.${format}`;
  if (format === "svg") saveFile(name, svg, "image/svg+xml");
  else saveFile(name, await pngOf(svg), "image/png");
};

const pngOf = async (svg: string): Promise<Blob> => {
  const url = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = url;
    await image.decode();
    const scale = PNG_PX / Math.max(image.naturalWidth, image.naturalHeight, 1);
    const canvas = document.createElement("canvas");
    canvas.width = Math.max(1, Math.round(image.naturalWidth * scale));
    canvas.height = Math.max(1, Math.round(image.naturalHeight * scale));
    const context = canvas.getContext("2d");
    if (context === null) throw new Error("This browser can’t draw the picture. Save it as SVG.");
    context.fillStyle = PAPER;
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    const png = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/png"));
    if (png === null) throw new Error("This browser can’t make the picture. Save it as SVG.");
    return png;
  } finally {
    URL.revokeObjectURL(url);
  }
};
