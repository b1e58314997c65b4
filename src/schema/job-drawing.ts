/** How a new job names its drawing: by its text, or by the id of an upload. */
export const hasOneDrawing = (job: {
  readonly drawing?: string | undefined;
  readonly drawingId?: string | undefined;
}): boolean => (job.drawing === undefined) !== (job.drawingId === undefined);

export const ONE_DRAWING = { path: ["drawing"], message: "send either drawing or drawingId" };
