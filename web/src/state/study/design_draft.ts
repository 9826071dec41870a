import { signal } from '@preact/signals';

import { studyText } from '../../text/study_text';
import type { NewStudyDesign } from '../../wire/rest_types';

/** One arm as it is being filled in. */
export interface ArmDraft {
  name: string;
  trainingSessions: number;
  theatre: boolean;
}

/** As many as the server takes. */
export const maxArms = 6;

/** The design of a study as it is being filled in: tests before and after, and how each arm trains. */
export class DesignDraft {
  readonly used = signal(false);
  readonly preSessions = signal(1);
  readonly postSessions = signal(1);
  readonly retentionSessions = signal(0);
  readonly retentionAfterDays = signal(14);
  readonly testTheatre = signal(false);
  readonly arms = signal<readonly ArmDraft[]>([
    { name: studyText.trainingArm, trainingSessions: 5, theatre: false },
    { name: studyText.controlArm, trainingSessions: 0, theatre: false },
  ]);

  get complete(): boolean {
    return !this.used.value || this.arms.value.every((arm) => arm.name.trim() !== '');
  }

  change(place: number, changes: Partial<ArmDraft>): void {
    this.arms.value = this.arms.value.map((arm, i) => (i === place ? { ...arm, ...changes } : arm));
  }
  add(): void {
    const number = this.arms.value.length + 1;
    this.arms.value = [...this.arms.value, { name: studyText.armNumber(number), trainingSessions: 5, theatre: false }];
  }
  remove(place: number): void {
    this.arms.value = this.arms.value.filter((_, i) => i !== place);
  }

  /** Null: none is wanted. */
  design(): NewStudyDesign | null {
    if (!this.used.value) return null;
    return {
      arms: this.arms.value.map((arm, i) => ({
        id: armId(arm.name, i),
        name: arm.name.trim(),
        training_sessions: arm.trainingSessions,
        theatre: arm.theatre,
      })) as NewStudyDesign['arms'],
      pre_sessions: this.preSessions.value,
      post_sessions: this.postSessions.value,
      retention_sessions: this.retentionSessions.value,
      retention_after_days: this.retentionAfterDays.value,
      test_theatre: this.testTheatre.value,
    };
  }
}

/** "Training with sound" is training_with_sound_1; the number keeps two of one name apart. */
function armId(name: string, place: number): string {
  const plain = name
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, '_')
    .replace(/^[^a-z]+|_+$/g, '');
  return `${(plain === '' ? 'arm' : plain).slice(0, 50)}_${place + 1}`;
}
