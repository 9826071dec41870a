export const traceColumns = ['thrustN', 'feedRateMmS', 'vibrationG'] as const;
export type TraceColumn = (typeof traceColumns)[number];

/** Entries that follow each other, parallel; a column that is shorter or missing has holes. */
export type TraceBatch = Partial<Record<TraceColumn, ArrayLike<number>>>;

/** A line to be drawn: parallel lists of seconds and values, null where it is broken. */
export interface TraceLine {
  seconds: number[];
  values: (number | null)[];
}

/**
 * The newest ticks of a session's trace, in a ring. A hole in the trace (telemetry may be dropped) is kept as one entry
 * without values, so that it is drawn as a gap and not bridged.
 */
export class LiveTrace {
  private readonly ticks: Float64Array;
  private readonly columns: Record<TraceColumn, Float64Array>;
  private head = 0;
  private count = 0;
  private nextTick: number | null = null;

  /** Holds at most `capacity` entries. */
  constructor(capacity: number) {
    this.ticks = new Float64Array(capacity);
    const column = () => new Float64Array(capacity);
    this.columns = { thrustN: column(), feedRateMmS: column(), vibrationG: column() };
  }

  /** Adds entries of ticks firstTick, firstTick + stride and so on; older or repeated ticks are left out. */
  append(firstTick: number, stride: number, batch: TraceBatch): void {
    if (this.nextTick !== null && firstTick > this.nextTick) this.push(this.nextTick, {}, 0);
    const entries = Math.max(...traceColumns.map((name) => batch[name]?.length ?? 0));
    for (let i = 0; i < entries; ++i) {
      const tick = firstTick + i * stride;
      if (this.nextTick !== null && tick < this.nextTick) continue;
      this.push(tick, batch, i);
      this.nextTick = tick + stride;
    }
  }

  clear(): void {
    this.head = 0;
    this.count = 0;
    this.nextTick = null;
  }

  /** Newest value, or null without any. */
  newest(name: TraceColumn): number | null {
    const value = this.count === 0 ? NaN : this.columns[name][this.slot(this.count - 1)];
    return value === undefined || Number.isNaN(value) ? null : value;
  }

  /** Root mean square over the last `seconds`, or null without any entry. */
  rms(name: TraceColumn, seconds: number): number | null {
    let sum = 0;
    let entries = 0;
    const from = this.newestTick() - seconds * 1000;
    for (let i = this.count - 1; i >= 0 && (this.ticks[this.slot(i)] ?? 0) > from; --i) {
      const value = this.columns[name][this.slot(i)] ?? NaN;
      if (Number.isNaN(value)) continue;
      sum += value * value;
      ++entries;
    }
    return entries === 0 ? null : Math.sqrt(sum / entries);
  }

  /**
   * The last `seconds`, oldest first. Where there are more entries than `mostPoints`, the least and the greatest of as
   * many as make two points stand for all, in their order: no peak of a single tick is lost. Which entries go together
   * does not change as the line rolls on.
   */
  line(name: TraceColumn, seconds: number, mostPoints: number): TraceLine {
    const line: TraceLine = { seconds: [], values: [] };
    const from = this.newestTick() - seconds * 1000;
    const ticksInPair = Math.ceil((2 * seconds * 1000) / mostPoints);
    const pair = new Extremes(line);
    for (let i = 0; i < this.count; ++i) {
      const slot = this.slot(i);
      const tick = this.ticks[slot] ?? 0;
      if (tick < from) continue;
      pair.take(Math.floor(tick / ticksInPair), tick, this.columns[name][slot] ?? NaN);
    }
    pair.flush();
    return line;
  }

  private newestTick(): number {
    return this.count === 0 ? 0 : (this.ticks[this.slot(this.count - 1)] ?? 0);
  }

  private push(tick: number, batch: TraceBatch, entry: number): void {
    const capacity = this.ticks.length;
    const slot = (this.head + this.count) % capacity;
    this.ticks[slot] = tick;
    for (const name of traceColumns) this.columns[name][slot] = batch[name]?.[entry] ?? NaN;
    if (this.count < capacity) ++this.count;
    else this.head = (this.head + 1) % capacity;
  }

  private slot(i: number): number {
    return (this.head + i) % this.ticks.length;
  }
}

/** Least and greatest of entries that go together, put into the line as soon as others begin. */
class Extremes {
  private group = NaN;
  private least = NaN;
  private greatest = NaN;
  private leastTick = 0;
  private greatestTick = 0;

  constructor(private readonly line: TraceLine) {}

  take(group: number, tick: number, value: number): void {
    if (group !== this.group || Number.isNaN(value)) this.flush();
    this.group = group;
    if (Number.isNaN(value)) return this.add(tick, null);
    if (!(value >= this.least)) [this.least, this.leastTick] = [value, tick];
    if (!(value <= this.greatest)) [this.greatest, this.greatestTick] = [value, tick];
  }

  flush(): void {
    if (Number.isNaN(this.least)) return;
    const leastFirst = this.leastTick <= this.greatestTick;
    this.add(leastFirst ? this.leastTick : this.greatestTick, leastFirst ? this.least : this.greatest);
    if (this.leastTick !== this.greatestTick)
      this.add(leastFirst ? this.greatestTick : this.leastTick, leastFirst ? this.greatest : this.least);
    this.least = NaN;
    this.greatest = NaN;
  }

  private add(tick: number, value: number | null): void {
    this.line.seconds.push(tick / 1000);
    this.line.values.push(value);
  }
}
