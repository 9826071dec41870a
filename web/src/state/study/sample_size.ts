import { batch, signal } from '@preact/signals';

import { feelText } from '../../text/feel_text';
import { messageOf } from '../../wire/rest';
import type { SampleInput, SampleQuestion, SampleSize } from '../../wire/rest_types';
import type { StudyApi } from '../../wire/study_api';

export type SampleField = keyof typeof feelText.sampleFields;

/** What each question depends on. */
export const fieldsOf: Record<SampleQuestion, readonly SampleField[]> = {
  means: ['effect', 'power'],
  shares: ['first', 'second', 'power'],
  agreement: ['raters', 'expected', 'least'],
  precision: ['raters', 'expected', 'width'],
};

/** Between what a number can be as it is typed in, and by what it grows. */
export const rangeOf: Record<SampleField, { min: number; max: number; step: number }> = {
  effect: { min: 0.01, max: 10, step: 0.1 },
  first: { min: 0, max: 100, step: 1 },
  second: { min: 0, max: 100, step: 1 },
  raters: { min: 2, max: 100, step: 1 },
  expected: { min: 0, max: 1, step: 0.05 },
  least: { min: 0, max: 1, step: 0.05 },
  width: { min: 0.01, max: 1.99, step: 0.05 },
  power: { min: 50, max: 99.9, step: 1 },
};

/** A large difference, as simulators show between novices and experts; raters as in most published studies. */
const startValues: Readonly<Record<SampleField, number>> = {
  ...{ effect: 0.8, first: 50, second: 80, power: 80 },
  ...{ raters: 2, expected: 0.8, least: 0.5, width: 0.3 },
};
const percentFields: readonly SampleField[] = ['first', 'second', 'power'];
const waitMs = 400;

/** How many participants a study needs, asked of the server a moment after something was changed. */
export class SampleSizeForm {
  readonly question = signal<SampleQuestion>('means');
  /** As typed in, shares in percent; NaN where nothing is. */
  readonly values = signal(startValues);
  /** Words; null while it is not known. */
  readonly answer = signal<{ size: string; source: string } | null>(null);
  readonly problem = signal<string | null>(null);
  private timer: ReturnType<typeof setTimeout> | undefined;
  private askedNumber = 0;

  constructor(private readonly api: Pick<StudyApi, 'sampleSize'>) {}

  choose(question: SampleQuestion): void {
    this.question.value = question;
    this.forget();
    void this.ask();
  }
  set(field: SampleField, value: number): void {
    this.values.value = { ...this.values.value, [field]: value };
    this.forget();
    this.timer = setTimeout(() => void this.ask(), waitMs);
  }
  dispose(): void {
    this.forget();
  }

  /** Asks for what is typed in now. Of two questions at once the later one counts. */
  async ask(): Promise<void> {
    this.forget();
    const number = this.askedNumber;
    const input = this.input();
    try {
      const size = await this.api.sampleSize(input);
      if (number === this.askedNumber) this.answer.value = words(size, input);
    } catch (error) {
      if (number === this.askedNumber) this.problem.value = messageOf(error);
    }
  }

  /** What was answered is not of what is typed in now. */
  private forget(): void {
    clearTimeout(this.timer);
    ++this.askedNumber;
    batch(() => {
      this.answer.value = null;
      this.problem.value = null;
    });
  }

  /** What is not typed in is left out: the server says what is missing. */
  private input(): SampleInput {
    const question = this.question.value;
    const fields = fieldsOf[question].filter((field) => Number.isFinite(this.values.value[field]));
    const asked = fields.map((field) => {
      const value = this.values.value[field];
      return [field, percentFields.includes(field) ? value / 100 : value] as const;
    });
    return { question, ...Object.fromEntries(asked) };
  }
}

function words({ needed, per_group: perGroup, source }: SampleSize, { raters }: SampleInput) {
  const size = perGroup ? feelText.perGroup(needed) : feelText.perSession(needed, raters ?? 2);
  return { size, source };
}
