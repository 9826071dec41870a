import { signal } from '@preact/signals';

const keptSamples = 600;
/** Older delays say nothing about now. */
const keptMs = 20_000;
const leastSamples = 10;
/** Sent inputs that no tick has answered are given up after so many. */
const waitingMost = 256;

/** The newest delays, and what 95 of 100 of them stay under. Times are of one clock, ms. */
export class DelayWindow {
  private readonly delays = new Float64Array(keptSamples);
  private readonly takenMs = new Float64Array(keptSamples);
  private next = 0;
  private count = 0;

  add(delayMs: number, nowMs: number): void {
    this.delays[this.next] = delayMs;
    this.takenMs[this.next] = nowMs;
    this.next = (this.next + 1) % keptSamples;
    this.count = Math.min(this.count + 1, keptSamples);
  }

  clear(): void {
    this.count = 0;
    this.next = 0;
  }

  /** Null while there are too few of the last moments. */
  p95(nowMs: number): number | null {
    const recent = Array.from(this.delays.subarray(0, this.count))
      .filter((_, i) => nowMs - (this.takenMs[i] ?? 0) < keptMs)
      .sort((a, b) => a - b);
    if (recent.length < leastSamples) return null;
    return recent[Math.ceil(recent.length * 0.95) - 1] ?? null;
  }
}

/** What the hand sent at a time, and the tick by which the server had taken it. */
export interface Taken {
  sentMs: number;
  tick: number;
}

/**
 * How late the picture is. Of a hand on this page: from the moment at which it was sampled to the end of drawing the
 * first picture whose tick is not before the one by which the server had taken the sample; both by this page's clock, so
 * that no clocks are compared. Of what is only watched: from the arrival of a message to the end of drawing it.
 */
export class Latency {
  /** p95, ms; null while it is not known. */
  readonly handMs = signal<number | null>(null);
  readonly drawingMs = signal<number | null>(null);
  private readonly hand = new DelayWindow();
  private readonly drawing = new DelayWindow();
  private waiting: Taken[] = [];
  private drawnTick = -1;

  taken(sample: Taken): void {
    this.waiting.push(sample);
    if (this.waiting.length > waitingMost) this.waiting.shift();
  }

  /** A picture of this tick, whose message came at a time, is drawn. */
  drawn(tick: number, receivedMs: number, nowMs: number): void {
    if (tick === this.drawnTick) return;
    this.drawnTick = tick;
    this.drawing.add(nowMs - receivedMs, nowMs);
    // The oldest of them has waited longest for this picture; the others are shown by it as well.
    for (const { sentMs } of this.waiting.filter((sample) => sample.tick <= tick)) this.hand.add(nowMs - sentMs, nowMs);
    this.shows(tick);
  }

  /** The picture that is there is of this tick, too, as its message changed nothing: nothing waits for it any more. */
  shows(tick: number): void {
    this.waiting = this.waiting.filter((sample) => sample.tick > tick);
  }

  /** The ticks of another session are others. */
  forget(): void {
    this.waiting = [];
    this.drawnTick = -1;
    this.hand.clear();
    this.drawing.clear();
    this.publish(0);
  }

  /** To be called now and then. */
  publish(nowMs: number): void {
    this.handMs.value = this.hand.p95(nowMs);
    this.drawingMs.value = this.drawing.p95(nowMs);
  }
}
