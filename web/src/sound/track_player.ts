/** Samples wait this long before they are heard, so that batches may come unevenly. */
const waitS = 0.06;
/** What waits longer than this is left out: sound belongs to the picture. */
const longestWaitS = 0.25;
/** The player is this much faster or slower while a mean over so long is this share off what should wait: clocks differ. */
const drift = 0.01;
const meanS = 0.5;
const idleShare = 0.6;
/** Sound begins and ends within this time where samples begin and end. */
const fadeS = 0.004;

/** Plays samples of another rate as they come in: what is sent is heard, a moment later. */
export class TrackPlayer {
  private waiting: number[] = [];
  /** Between waiting[1] and waiting[2]. */
  private place = 0;
  private flowing = false;
  private gain = 0;
  private meanWaiting: number;

  /** Rates of the track and of what is heard, Hz. */
  constructor(
    private readonly trackHz: number,
    private readonly heardHz: number,
  ) {
    this.meanWaiting = waitS * trackHz;
  }

  add(samples: Float32Array): void {
    for (const sample of samples) this.waiting.push(Number.isFinite(sample) ? sample : 0);
    const most = Math.round(longestWaitS * this.trackHz);
    if (this.waiting.length > most) this.waiting.splice(0, this.waiting.length - Math.round(waitS * this.trackHz));
  }

  /** The next sample that is heard; 0 while nothing waits. */
  next(): number {
    const due = waitS * this.trackHz;
    if (!this.flowing) {
      if (this.waiting.length < due) return 0;
      this.flowing = true;
    }
    const [a, b, c, d] = this.waiting;
    if (a === undefined || b === undefined || c === undefined || d === undefined) {
      this.flowing = false;
      this.gain = 0;
      this.place = 0;
      this.waiting = [];
      return 0;
    }
    // Towards the end of what waits it fades, so that a gap makes no click.
    const goal = this.waiting.length > 4 + fadeS * this.trackHz ? 1 : 0;
    this.gain += Math.sign(goal - this.gain) * Math.min(Math.abs(goal - this.gain), 1 / (fadeS * this.heardHz));
    const heard = this.gain * cubic(a, b, c, d, this.place);
    this.meanWaiting += (this.waiting.length - this.meanWaiting) / (meanS * this.heardHz);
    const off = this.meanWaiting / due - 1;
    const pace = Math.abs(off) > idleShare ? 1 + drift * Math.sign(off) : 1;
    this.place += (pace * this.trackHz) / this.heardHz;
    while (this.place >= 1) {
      this.place -= 1;
      this.waiting.shift();
    }
    return heard;
  }
}

/** Catmull-Rom, `at` between b and c. */
function cubic(a: number, b: number, c: number, d: number, at: number): number {
  const slopeB = (c - a) / 2;
  const slopeC = (d - b) / 2;
  const rise = c - b;
  return b + at * (slopeB + at * (3 * rise - 2 * slopeB - slopeC + at * (slopeB + slopeC - 2 * rise)));
}
