/** The value of a layer in a record by layer id. Ids come from files, so an id may be "constructor". */
export const setFor = <T>(record: Readonly<Record<string, T>>, id: string): T | undefined =>
  Object.hasOwn(record, id) ? record[id] : undefined;
