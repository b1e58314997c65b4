/**
 * Closes all parts of a server: running plots first, so that pens lift and places are stored, then the other
 * parts in reverse order of opening. A part that hangs or fails is reported in the log, and closing continues
 * with the next.
 */
type CloseStep = () => Promise<void> | void;

/** A part that takes longer is considered hung. All parts together finish before systemd's timeout (60 s). */
const LIMIT_MS = 4_000;
/** Time to slow down, lift the pen and move home from the far corner. */
const PLOTS_LIMIT_MS = 30_000;

interface Part {
  readonly name: string;
  readonly close: CloseStep;
}

export class Closing {
  private readonly parts: Part[] = [];
  private readonly urgent: Part[] = [];
  private running: Promise<void> | null = null;
  private readonly limits: { readonly partMs: number; readonly plotsMs: number };

  constructor(
    private readonly log: (line: string) => void,
    limits: { readonly partMs: number; readonly plotsMs: number } = {
      partMs: LIMIT_MS,
      plotsMs: PLOTS_LIMIT_MS,
    },
  ) {
    this.limits = limits;
  }

  add(name: string, close: CloseStep): void {
    this.parts.push({ name, close });
  }

  /** Adds a part that is closed before the others, in parallel with the other urgent parts. */
  addUrgent(name: string, close: CloseStep): void {
    this.urgent.push({ name, close });
  }

  /** Closes everything. Never rejects; further calls return the same promise. */
  run(): Promise<void> {
    this.running ??= this.closeAll();
    return this.running;
  }

  private async closeAll(): Promise<void> {
    const { partMs, plotsMs } = this.limits;
    await Promise.all(this.urgent.splice(0).map((part) => this.close(part, plotsMs)));
    for (const part of this.parts.splice(0).reverse()) await this.close(part, partMs);
  }

  private async close({ name, close }: Part, limitMs: number): Promise<void> {
    let timer: NodeJS.Timeout | undefined;
    const late = new Promise<void>((resolve) => {
      timer = setTimeout(() => {
        this.log(`closing: ${name} did not close within ${limitMs / 1000} s; continuing without it`);
        resolve();
      }, limitMs);
    });
    const closed = (async () => close())().catch((error: unknown) => {
      this.log(`closing: ${name}: ${error instanceof Error ? error.message : String(error)}`);
    });
    await Promise.race([closed, late]);
    clearTimeout(timer);
  }
}
