import type { Outcome, TwinModule } from '../twin/twin_module';

/** Ticks between moments to which the bone goes back at once. */
const keepEveryTicks = 10_000;

const startCode = 1;
const segmentCode = 2;
const ticksCode = 3;
const densityCode = 5;

interface Step {
  part: Uint8Array;
  /** That have passed when the part is taken. */
  ticks: number;
}

type Twin = Pick<TwinModule, 'take' | 'keepMoment' | 'goTo'>;

/** The bone of a session at any moment, computed by its twin from the parts of its causes, a quarter of a second fine. */
export class BoneAt {
  private readonly steps: Step[];
  /** The step that comes next. */
  private next = 0;
  /** Moments that are kept, by number: of which step. */
  private readonly kept: { step: number; ticks: number }[] = [];
  private outcome: Outcome = 'agrees';

  /** `parts`: of a file of causes, in order. The bone is that of before the first tick. */
  constructor(
    private readonly twin: Twin,
    parts: readonly Uint8Array[],
  ) {
    let ticks = 0;
    const before = parts.filter((part) => part[0] === startCode || part[0] === densityCode);
    this.steps = parts
      .filter((part) => part[0] === segmentCode || part[0] === ticksCode)
      .map((part) => {
        if (part[0] === ticksCode) ticks += rowsOf(part);
        return { part, ticks };
      });
    for (const part of before) this.take(part);
    this.keep();
  }

  /** Ticks that have passed in the bone. */
  get ticks(): number {
    return this.next === 0 ? 0 : (this.steps[this.next - 1]?.ticks ?? 0);
  }

  /** Whether the bone can be computed up to here: the causes agree with the hashes that came with them. */
  get agrees(): boolean {
    return this.outcome === 'agrees';
  }

  /** Goes towards the last moment at or before `ticks`, for about `ms`; true when it is there, or cannot go on. */
  goTowards(ticks: number, ms: number, now: () => number = () => performance.now()): boolean {
    this.jumpTo(ticks);
    const until = now() + ms;
    for (;;) {
      const step = this.steps[this.next];
      if (step === undefined || step.ticks > ticks || !this.agrees) return true;
      if (now() >= until) return false;
      if (!this.take(step.part)) return true;
      ++this.next;
      if (step.ticks >= (this.kept.at(-1)?.ticks ?? 0) + keepEveryTicks || this.isKept()) this.keep();
    }
  }

  /** To the newest moment kept that leads to `ticks`, where that is nearer than what there is. */
  private jumpTo(ticks: number): void {
    let best = -1;
    for (const [number, moment] of this.kept.entries()) if (moment.ticks <= ticks) best = number;
    const moment = this.kept[best];
    if (moment === undefined || (this.ticks <= ticks && moment.step <= this.next)) return;
    if (this.twin.goTo(best)) {
      this.next = moment.step;
      this.outcome = 'agrees';
    }
  }

  private isKept(): boolean {
    return this.kept.some(({ step }) => step === this.next);
  }

  /** The twin counts moments as they are passed; one that is kept already stays as it is. */
  private keep(): void {
    if (!this.agrees) return;
    this.kept[this.twin.keepMoment()] ??= { step: this.next, ticks: this.ticks };
  }

  private take(part: Uint8Array): boolean {
    this.outcome = this.twin.take(part);
    return this.agrees;
  }
}

const rowsOf = (part: Uint8Array) => new DataView(part.buffer, part.byteOffset).getUint32(5, true);
