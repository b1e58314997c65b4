/** The sample drawings, as files beside the page. */
import { BackendFault } from "../backend.js";
import { browserText } from "./text.js";

/** By the file's path: a function that loads its URL. */
export type SampleFiles = Readonly<Record<string, () => Promise<string>>>;

const nameOf = (path: string): string => path.replace(/^.*\//, "");

/** "many-short-strokes.svg" -> "Many short strokes" */
const titleOf = (name: string): string => {
  const words = name.replace(/\.svg$/, "").replaceAll("-", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
};

export const sampleList = (files: SampleFiles): { readonly name: string; readonly title: string }[] =>
  Object.keys(files)
    .map(nameOf)
    .sort()
    .map((name) => ({ name, title: titleOf(name) }));

export const sampleText = async (files: SampleFiles, name: string): Promise<string> => {
  const load = Object.entries(files).find(([path]) => nameOf(path) === name)?.[1];
  const response = await load?.()
    .then((url) => fetch(url))
    .catch(() => null);
  if (response?.ok !== true) throw new BackendFault("unreachable", browserText.sampleMissing(name));
  return response.text();
};
