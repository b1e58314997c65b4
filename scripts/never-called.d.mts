export const NEVER_CALLED: RegExp;
export function emptied(source: string): string;
