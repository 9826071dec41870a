/**
 * The newest ticks of the force trace, in a ring. A hole in the trace (telemetry may be dropped) is kept as one entry
 * without a value, so that it is drawn as a gap and not bridged.
 */
export class ForceTrace {
  private readonly ticks: Float64Array;
  private readonly values: Float64Array;
  private head = 0;
  private count = 0;
  private nextTick: number | null = null;

  /** Holds at most `capacity` entries. */
  constructor(capacity: number) {
    this.ticks = new Float64Array(capacity);
    this.values = new Float64Array(capacity);
  }

  /** Adds entries of ticks firstTick, firstTick + stride and so on; older or repeated ticks are left out. */
  append(firstTick: number, stride: number, values: ArrayLike<number>): void {
    if (this.nextTick !== null && firstTick > this.nextTick) this.push(this.nextTick, NaN);
    for (let i = 0; i < values.length; ++i) {
      const tick = firstTick + i * stride;
      if (this.nextTick !== null && tick < this.nextTick) continue;
      this.push(tick, values[i] ?? NaN);
      this.nextTick = tick + stride;
    }
  }

  clear(): void {
    this.head = 0;
    this.count = 0;
    this.nextTick = null;
  }

  /** Newest value, or null without any. */
  newest(): number | null {
    const value = this.count === 0 ? NaN : this.values[this.slot(this.count - 1)];
    return value === undefined || Number.isNaN(value) ? null : value;
  }

  /** Entries of the last `seconds`, oldest first, as parallel lists of seconds and values (null: a gap). */
  window(seconds: number): { seconds: number[]; values: (number | null)[] } {
    const times: number[] = [];
    const values: (number | null)[] = [];
    const end = this.count === 0 ? 0 : (this.ticks[this.slot(this.count - 1)] ?? 0);
    for (let i = 0; i < this.count; ++i) {
      const tick = this.ticks[this.slot(i)] ?? 0;
      if (tick < end - seconds * 1000) continue;
      const value = this.values[this.slot(i)] ?? NaN;
      times.push(tick / 1000);
      values.push(Number.isNaN(value) ? null : value);
    }
    return { seconds: times, values };
  }

  private push(tick: number, value: number): void {
    const capacity = this.ticks.length;
    const slot = (this.head + this.count) % capacity;
    this.ticks[slot] = tick;
    this.values[slot] = value;
    if (this.count < capacity) ++this.count;
    else this.head = (this.head + 1) % capacity;
  }

  private slot(i: number): number {
    return (this.head + i) % this.ticks.length;
  }
}
