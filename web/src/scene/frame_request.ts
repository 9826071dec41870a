/** Everything on the page that has changed and is not drawn yet. */
const pending = new Set<FrameRequest>();

/** Until all that has changed on the page so far is drawn. */
export async function allDrawn(): Promise<void> {
  await Promise.all([...pending].map((request) => request.done()));
}

/** A drawing that is asked for by whatever changes, and is done once, in one of the browser's next frames. */
export class FrameRequest {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private frame: number | null = null;
  private held: ReturnType<typeof setTimeout> | undefined;
  private disposed = false;
  private resolvers: (() => void)[] = [];

  /** With `frames` more than 1 the browser has that many frames for each drawing. */
  constructor(
    private readonly draw: () => void,
    private readonly frames = 1,
  ) {}

  /** Something is asked for and not drawn yet. */
  get isWaiting(): boolean {
    return pending.has(this);
  }

  request(): void {
    clearTimeout(this.timer);
    if (this.frame !== null || this.disposed) return;
    pending.add(this);
    if (this.held === undefined) this.waitFor(this.frames);
  }

  /** Draws nothing before release(), or for so long; what is asked for meanwhile, or was before, is drawn then. */
  hold(ms: number): void {
    if (this.disposed) return;
    clearTimeout(this.held);
    this.held = setTimeout(() => this.release(), ms);
    if (this.frame !== null) cancelAnimationFrame(this.frame);
    this.frame = null;
  }

  release(): void {
    if (this.held === undefined) return;
    clearTimeout(this.held);
    this.held = undefined;
    if (this.isWaiting) this.request();
  }

  /** Waits for `ms` without another call before it asks for a frame. */
  requestAfter(ms: number): void {
    clearTimeout(this.timer);
    if (this.disposed) return;
    pending.add(this);
    this.timer = setTimeout(() => this.request(), ms);
  }

  /** What was asked for is not drawn. */
  cancel(): void {
    clearTimeout(this.timer);
    if (this.frame !== null) cancelAnimationFrame(this.frame);
    this.end();
  }

  /** Nothing is drawn any more. */
  dispose(): void {
    clearTimeout(this.held);
    this.cancel();
    this.disposed = true;
  }

  /** Until what was asked for is drawn or given up. */
  done(): Promise<void> {
    return new Promise((resolve) => this.resolvers.push(resolve));
  }

  private waitFor(frames: number): void {
    this.frame = requestAnimationFrame(() => {
      if (frames > 1) return this.waitFor(frames - 1);
      // The drawing itself may ask for the next one.
      this.end(this.draw);
    });
  }

  private end(draw?: () => void): void {
    this.frame = null;
    pending.delete(this);
    const resolvers = this.resolvers.splice(0);
    draw?.();
    for (const resolve of resolvers) resolve();
  }
}
