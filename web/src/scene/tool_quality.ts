import { computed, type ReadonlySignal, signal } from '@preact/signals';

import type { ToolDrawing } from '../state/view_settings';

/** So many pictures tell whether they are drawn fast enough. */
const pictures = 60;
const slowMs = 25;
/** Between two pictures that are further apart the page was not seen. */
const unseenMs = 1000;

/** Whether the reamer is drawn in full, or plain because that was chosen or pictures take too long. */
export class ToolQuality {
  readonly full: ReadonlySignal<boolean> = computed(() =>
    this.choice.value === 'automatic' ? !this.slow.value : this.choice.value === 'full',
  );
  private readonly choice = signal<ToolDrawing>('automatic');
  private readonly slow: { value: boolean };
  private took: number[] = [];

  /** `software`: whether WebGL is drawn by the computer's processor. */
  constructor(private readonly software: boolean) {
    this.slow = signal(software);
  }

  choose(choice: ToolDrawing): void {
    if (choice === this.choice.peek()) return;
    this.choice.value = choice;
    this.slow.value = this.software;
    this.took = [];
  }

  /** From one picture to the next, which was asked for at once: as long as both together need to be drawn. */
  drawnAfter(ms: number): void {
    if (ms > unseenMs || this.slow.value || this.choice.peek() !== 'automatic') return;
    this.took.push(ms);
    if (this.took.length < pictures) return;
    const median = this.took.sort((a, b) => a - b)[pictures / 2] ?? 0;
    this.took = [];
    if (median > slowMs) this.slow.value = true;
  }
}
