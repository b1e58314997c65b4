/** The elements and attributes of a tree, as in `SvgTree`: columns of one length that grow together. */
import { grown } from "../../geometry/growable.js";

export class ElementColumns {
  count = 0;
  tags = new Uint32Array(64);
  parents = new Int32Array(64);
  firstChildren = new Int32Array(64);
  nextSiblings = new Int32Array(64);
  /** One more than elements: where the attributes of each begin, and at last where they end. */
  attributeOffsets = new Uint32Array(64);
  lines = new Uint32Array(64);

  /** Adds an element after `before`, its elder sibling, or as the first one in `parent` where that is −1. */
  add(tag: number, parent: number, before: number, attributesFrom: number, line: number): number {
    const element = this.count++;
    // One place stays free, for the end of the last one's attributes.
    if (element + 1 === this.tags.length) this.grow(0);
    this.tags[element] = tag;
    this.parents[element] = parent;
    this.firstChildren[element] = -1;
    this.nextSiblings[element] = -1;
    this.attributeOffsets[element] = attributesFrom;
    this.lines[element] = line;
    if (before >= 0) this.nextSiblings[before] = element;
    else if (parent >= 0) this.firstChildren[parent] = element;
    return element;
  }

  /** Adds `count` younger siblings of element `before`, which has none, like it in all, each so many lines further down. */
  addLike(
    before: number,
    count: number,
    attributesEach: number,
    attributesFrom: number,
    linesEach: number,
  ): void {
    const first = this.count;
    const end = first + count;
    if (end >= this.tags.length) this.grow(end + 1);
    this.tags.fill(this.tags[before], first, end);
    this.parents.fill(this.parents[before], first, end);
    this.firstChildren.fill(-1, first, end);
    const { nextSiblings, attributeOffsets, lines } = this;
    let line = lines[before];
    for (let k = 0; k < count; k++) {
      const element = first + k;
      nextSiblings[element] = element + 1;
      attributeOffsets[element] = attributesFrom + k * attributesEach;
      lines[element] = line += linesEach;
    }
    nextSiblings[before] = first;
    nextSiblings[end - 1] = -1;
    this.count = end;
  }

  private grow(needed: number): void {
    this.tags = grown(this.tags, needed);
    this.parents = grown(this.parents, needed);
    this.firstChildren = grown(this.firstChildren, needed);
    this.nextSiblings = grown(this.nextSiblings, needed);
    this.attributeOffsets = grown(this.attributeOffsets, needed);
    this.lines = grown(this.lines, needed);
  }
}

export class AttributeColumns {
  count = 0;
  names = new Uint32Array(64);
  places = new Uint32Array(64);

  add(name: number, place: number): void {
    const i = this.count++;
    if (i === this.names.length) {
      this.names = grown(this.names);
      this.places = grown(this.places);
    }
    this.names[i] = name;
    this.places[i] = place;
  }

  /**
   * Adds `count` times the last `each` attributes. Of these, number `changed[k]` stands elsewhere each time: at the k-th of
   * the next places, of which there are as many as in `changed` (negative ones among them are passed over).
   */
  addLike(count: number, each: number, changed: readonly number[], changedPlaces: Uint32Array): void {
    const from = this.count;
    this.count += count * each;
    if (this.count > this.names.length) {
      this.names = grown(this.names, this.count);
      this.places = grown(this.places, this.count);
    }
    const { names, places } = this;
    for (let i = from; i < this.count; i++) {
      names[i] = names[i - each];
      places[i] = places[i - each];
    }
    const many = changed.length;
    for (let k = 0; k < many; k++) {
      if (changed[k] < 0) continue;
      let i = from + changed[k];
      for (let n = k; n < count * many; n += many) {
        places[i] = changedPlaces[n];
        i += each;
      }
    }
  }
}
