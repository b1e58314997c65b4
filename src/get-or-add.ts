/** The value of `key`; if it has none, the value that `make` returns, which is added to the map. */
export function getOrAdd<K, V>(map: Map<K, V>, key: K, make: () => V): V {
  let value = map.get(key);
  if (value === undefined) {
    value = make();
    map.set(key, value);
  }
  return value;
}

/** `make`, whose latest results are remembered: at most `limit` of them. */
export function remembered<V>(limit: number, make: (text: string) => V): (text: string) => V {
  const known = new Map<string, V>();
  return (text) => {
    if (known.size >= limit) known.clear();
    return getOrAdd(known, text, () => make(text));
  };
}
