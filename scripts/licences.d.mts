import type { Plugin } from "vite";

export function licencePlugins(): { readonly inWorkers: () => Plugin; readonly inPage: () => Plugin };
export function licencesOf(files: readonly string[]): string;
