import { PartFileError } from '../twin/part_file';
import type { TwinModule } from '../twin/twin_module';

/** Between snapshots to which the bone goes at once; of a long session more, as each takes some 100 kB. */
const snapshotEveryTicks = 2500;
const maxSnapshots = 200;

const startCode = 1;
const segmentCode = 2;
const ticksCode = 3;
const densityCode = 5;

interface Step {
  part: Uint8Array;
  /** That have passed when the part is taken. */
  ticks: number;
}

type Twin = Pick<TwinModule, 'take' | 'keepSnapshot' | 'goTo'>;

/** The bone of a session at any moment, in steps of a quarter of a second, computed by its twin from the parts of its causes. */
export class BoneAt {
  private readonly steps: Step[];
  private readonly everyTicks: number;
  /** The step that comes next. */
  private next = 0;
  /** Snapshots by number: which step comes next there. */
  private readonly kept: { step: number; ticks: number }[] = [];
  private limit = Infinity;
  /** All has been computed once, as far as it goes. */
  private done = false;

  /** `parts`: of a file of causes, in order. The bone is that of before the first tick. Throws where there is none. */
  constructor(
    private readonly twin: Twin,
    parts: readonly Uint8Array[],
  ) {
    let ticks = 0;
    this.steps = parts
      .filter((part) => part[0] === segmentCode || part[0] === ticksCode)
      .map((part) => {
        if (part[0] === ticksCode) ticks += rowsOf(part);
        return { part, ticks };
      });
    this.everyTicks = Math.max(snapshotEveryTicks, Math.ceil(ticks / maxSnapshots));
    for (const part of parts)
      if ((part[0] === startCode || part[0] === densityCode) && twin.take(part) !== 'agrees')
        throw new PartFileError('the causes do not begin with a bone');
    this.keep();
  }

  /** Ticks that have passed in the bone. */
  get ticks(): number {
    return this.next === 0 ? 0 : (this.steps[this.next - 1]?.ticks ?? 0);
  }

  /** The bone is known up to here: what comes then does not agree with its hash. Infinity: no such place has been found. */
  get limitTicks(): number {
    return this.limit;
  }

  /** Goes towards the last moment at or before `ticks` and the limit, for about `ms`; true when it is there. */
  goTowards(ticks: number, ms: number, now: () => number = () => performance.now()): boolean {
    this.jumpTo(Math.min(ticks, this.limit));
    const until = now() + ms;
    for (;;) {
      const step = this.steps[this.next];
      if (step === undefined || step.ticks > Math.min(ticks, this.limit)) return true;
      if (now() >= until) return false;
      if (this.twin.take(step.part) !== 'agrees') {
        this.endHere();
        return true;
      }
      ++this.next;
      if (step.ticks >= (this.kept.at(-1)?.ticks ?? 0) + this.everyTicks || this.isKept()) this.keep();
    }
  }

  /**
   * Computes on from the furthest snapshot, for about `ms`, so that what is asked for later is there soon; true while there is
   * more. The bone is anywhere then: goTowards() comes before it is shown.
   */
  lookAhead(ms: number, now: () => number = () => performance.now()): boolean {
    if (this.done) return false;
    this.done = this.goTowards(Infinity, ms, now);
    return !this.done;
  }

  /** What was cut before its hash did not agree is not shown. */
  private endHere(): void {
    const last = this.kept.length - 1;
    this.limit = this.kept[last]?.ticks ?? 0;
    if (!this.twin.goTo(last)) throw new PartFileError('a snapshot is gone');
    this.next = this.kept[last]?.step ?? 0;
  }

  /** To the newest snapshot that leads to `ticks`, where that is nearer than what there is. */
  private jumpTo(ticks: number): void {
    let best = -1;
    for (const [number, snapshot] of this.kept.entries()) if (snapshot.ticks <= ticks) best = number;
    const snapshot = this.kept[best];
    if (snapshot === undefined || (this.ticks <= ticks && snapshot.step <= this.next)) return;
    if (!this.twin.goTo(best)) throw new PartFileError('a snapshot is gone');
    this.next = snapshot.step;
  }

  private isKept(): boolean {
    return this.kept.some(({ step }) => step === this.next);
  }

  /** The twin counts snapshots as they are passed; one that is there already stays as it is. */
  private keep(): void {
    const number = this.twin.keepSnapshot();
    if (number !== null) this.kept[number] ??= { step: this.next, ticks: this.ticks };
  }
}

const rowsOf = (part: Uint8Array) => new DataView(part.buffer, part.byteOffset).getUint32(5, true);
