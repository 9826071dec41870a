import { computed, type ReadonlySignal, signal } from '@preact/signals';

import { type PictureLevel, pictureLevels, type PictureChoice } from '../state/view_settings';

/** So many pictures tell whether they are drawn fast enough. */
const pictures = 60;
const slowMs = 25;
/** Between two pictures that are further apart the page was not seen. */
const unseenMs = 1000;

/** How much is drawn: as was chosen, or as much as is drawn fast enough. */
export class PictureQuality {
  readonly level: ReadonlySignal<PictureLevel> = computed(() =>
    this.choice.value === 'automatic' ? this.fastEnough.value : this.choice.value,
  );
  /** Whether more than the plain picture is drawn. */
  readonly full: ReadonlySignal<boolean> = computed(() => this.level.value !== 'plain');
  private readonly choice = signal<PictureChoice>('automatic');
  private readonly fastEnough: { value: PictureLevel; peek(): PictureLevel };
  private took: number[] = [];

  /** `software`: whether WebGL is drawn by the computer's processor. */
  constructor(private readonly software: boolean) {
    this.fastEnough = signal<PictureLevel>(this.firstLevel);
  }

  choose(choice: PictureChoice): void {
    if (choice === this.choice.peek()) return;
    this.choice.value = choice;
    this.fastEnough.value = this.firstLevel;
    this.took = [];
  }

  /** From one picture to the next, which was asked for at once: as long as both together need to be drawn. */
  drawnAfter(ms: number): void {
    const lower = pictureLevels[pictureLevels.indexOf(this.fastEnough.peek()) - 1];
    if (ms > unseenMs || lower === undefined || this.choice.peek() !== 'automatic') return;
    this.took.push(ms);
    if (this.took.length < pictures) return;
    const median = this.took.sort((a, b) => a - b)[pictures / 2] ?? 0;
    this.took = [];
    if (median > slowMs) this.fastEnough.value = lower;
  }

  private get firstLevel(): PictureLevel {
    return this.software ? 'plain' : 'fine';
  }
}
