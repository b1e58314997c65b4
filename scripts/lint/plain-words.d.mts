/** Every odd phrase in a text, at `index`; `plain`: what to write instead. */
export function oddWordsIn(text: string): Iterable<{ index: number; phrase: string; plain: string }>;
