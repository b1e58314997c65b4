/** The elements and attributes of a tree, as in `SvgTree`: columns of one length that grow together. */
import { grown } from "../geometry/growable.js";

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
    if (element + 1 === this.tags.length) this.grow();
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

  private grow(): void {
    this.tags = grown(this.tags);
    this.parents = grown(this.parents);
    this.firstChildren = grown(this.firstChildren);
    this.nextSiblings = grown(this.nextSiblings);
    this.attributeOffsets = grown(this.attributeOffsets);
    this.lines = grown(this.lines);
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
}
