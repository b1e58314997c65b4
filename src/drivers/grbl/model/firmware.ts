/**
 * What a plan needs to know of a Grbl's version: "Grbl 1.1h", "grblHAL 1.1f", "FluidNC 3.7.16" or "DrawCore 2.09". Apart from
 * protocol.ts, so that a page loads that only with a connection.
 */

/** Whether a version names Grbl or one of its children. */
export const isOwnVersion = (version: string): boolean => /^(Grbl|grblHAL|FluidNC|DrawCore) /.test(version);

/** Whether a board of that version takes arcs, if its profile says so; null: unknown. A DrawCore does not. */
export const takesArcs = (version: string | null): boolean => !version?.startsWith("DrawCore");
