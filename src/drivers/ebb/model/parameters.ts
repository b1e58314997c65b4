/** Parses a command's parameters as the board does: comma, digits, `-` only where a sign is allowed. */

/** An error that the board reports as "!n text". */
export class BoardFault extends Error {
  constructor(
    readonly code: number,
    readonly text: string,
  ) {
    super(`!${code} ${text}`);
  }
}

export const invalidValue = (): BoardFault => new BoardFault(6, "Err: Invalid parameter value");

export class Parameters {
  private readonly fields: string[];
  private next = 0;

  /**
   * `rest`: the text after the command name; empty or starting with a comma. The board notices another beginning only
   * when it reads a parameter: a command without parameters runs all the same.
   */
  constructor(private readonly rest: string) {
    this.fields = rest === "" ? [] : rest.slice(1).split(",");
  }

  get hasMore(): boolean {
    return this.next < this.fields.length;
  }

  uint(max = 2 ** 32 - 1): number {
    return this.number(0, max);
  }

  int(): number {
    return this.number(-(2 ** 31), 2 ** 31 - 1);
  }

  optionalUint(otherwise: number, max = 2 ** 32 - 1): number {
    return this.hasMore ? this.uint(max) : otherwise;
  }

  text(maxLength: number): string {
    this.mustBeginWithComma();
    return this.fields.splice(this.next).join(",").slice(0, maxLength);
  }

  private number(min: number, max: number): number {
    const field = this.fields[this.next];
    if (field === undefined) throw new BoardFault(4, "Err: Missing parameter(s)");
    this.mustBeginWithComma();
    this.next++;
    if (!/^-?\d{0,10}$/.test(field)) throw invalidValue();
    const value = field === "" || field === "-" ? 0 : Number(field);
    if (value < min || value > max || (min === 0 && field.startsWith("-"))) throw invalidValue();
    return value;
  }

  private mustBeginWithComma(): void {
    const [first = ","] = this.rest;
    if (first !== ",") throw new BoardFault(5, `Err: Need comma next, found: '${first}'`);
  }
}
