/** Growing pauses between attempts: 0.25 s doubled up to 3 s. */
export class Backoff {
  static readonly firstMs = 250;
  static readonly longestMs = 3000;

  private nextMs = Backoff.firstMs;

  /** The pause before the next attempt. */
  take(): number {
    const pauseMs = this.nextMs;
    this.nextMs = Math.min(this.nextMs * 2, Backoff.longestMs);
    return pauseMs;
  }

  reset(): void {
    this.nextMs = Backoff.firstMs;
  }
}
