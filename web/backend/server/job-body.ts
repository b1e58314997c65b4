/** A new job with a large drawing as JSON, made part by part: one text of all of it would hold up the page. */
const PART_BYTES = 1_000_000;

interface LargeJob {
  readonly name: string;
  readonly drawing: ArrayBuffer;
}

/** Between two parts the page has its turn, since a blob is read elsewhere. */
export const jobBody = async ({ drawing, ...rest }: LargeJob): Promise<Blob> => {
  const file = new Blob([drawing]);
  const decoder = new TextDecoder();
  const quoted = (text: string): Blob => new Blob([JSON.stringify(text).slice(1, -1)]);
  const parts: BlobPart[] = [`${JSON.stringify(rest).slice(0, -1)},"drawing":"`];
  for (let from = 0; from < file.size; from += PART_BYTES) {
    const bytes = await file.slice(from, from + PART_BYTES).arrayBuffer();
    parts.push(quoted(decoder.decode(bytes, { stream: true })));
  }
  parts.push(quoted(decoder.decode()), '"}');
  return new Blob(parts, { type: "application/json" });
};
