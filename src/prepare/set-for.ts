/** What a record by layer id says of a layer. Ids come from files: one may be called "constructor". */
export const setFor = <T>(record: Readonly<Record<string, T>>, id: string): T | undefined =>
  Object.hasOwn(record, id) ? record[id] : undefined;
