/** Two clocks drift apart by less than this share of time. */
const driftShare = 0.001;

/**
 * How much later than usual messages come, of which each says when it was sent. The clocks of the two ends are not the
 * same; the message that was quickest of all tells how they lie.
 */
export class Lateness {
  private quickestMs = Infinity;
  private lastMs = 0;

  /** Of a message that was sent at `sentMs` by the server's clock and came at `cameMs` by ours; ms. */
  of(sentMs: number, cameMs: number): number {
    this.quickestMs += Math.max(cameMs - this.lastMs, 0) * driftShare;
    this.lastMs = cameMs;
    const tookMs = cameMs - sentMs;
    this.quickestMs = Math.min(this.quickestMs, tookMs);
    return tookMs - this.quickestMs;
  }
}
