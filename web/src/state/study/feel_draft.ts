import { signal } from '@preact/signals';

import type { FeelComparison, NewFeelTrials } from '../../wire/rest_types';

/** All that a study of feel can ask, in the order of the reamer's way. */
export const feelComparisons: readonly FeelComparison[] = [
  'cartilage',
  'bone_under_cartilage',
  'through_plate',
  'density',
];

export type TrialCount = NonNullable<NewFeelTrials['trials_per_comparison']>;
/** Even numbers, so that each plate can be the right one equally often. */
export const trialCounts: readonly TrialCount[] = [2, 4, 6, 8, 10, 12, 16, 20];

/** How long a trial takes, about. */
export const minutesPerTrial = 1;

/** The trials of a blind study of feel as they are being filled in. */
export class FeelDraft {
  /** Else the study is one of scores. */
  readonly used = signal(false);
  readonly comparisons = signal(feelComparisons);
  readonly trialsEach = signal<TrialCount>(8);

  get complete(): boolean {
    return this.comparisons.value.length > 0;
  }
  /** That each participant does. */
  get trials(): number {
    return this.comparisons.value.length * this.trialsEach.value;
  }

  toggle(comparison: FeelComparison): void {
    const chosen = this.comparisons.value;
    this.comparisons.value = feelComparisons.filter((one) => chosen.includes(one) !== (one === comparison));
  }

  feel(): NewFeelTrials {
    return {
      comparisons: [...this.comparisons.value] as NewFeelTrials['comparisons'],
      trials_per_comparison: this.trialsEach.value,
    };
  }
}
