import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { fieldsOf, rangeOf, SampleSizeForm } from '../../../src/state/study/sample_size';
import { ApiError } from '../../../src/wire/rest';
import type { SampleInput, SampleQuestion, SampleSize } from '../../../src/wire/rest_types';

describe('sample size', () => {
  let asked: SampleInput[];
  let answer: (input: SampleInput) => Promise<SampleSize>;
  let form: SampleSizeForm;
  beforeEach(() => {
    vi.useFakeTimers();
    asked = [];
    answer = () => Promise.resolve({ needed: 26, per_group: true, source: 'Cohen 1988' });
    form = new SampleSizeForm({
      sampleSize: (input) => {
        asked.push(input);
        return answer(input);
      },
    });
  });
  afterEach(() => vi.useRealTimers());

  it('is said in a sentence, with its source', async () => {
    await form.ask();
    expect(asked).toEqual([{ question: 'means', effect: 0.8, power: 0.8 }]);
    expect(form.answer.value).toEqual({ size: '26 people in each of two groups.', source: 'Cohen 1988' });
    answer = () => Promise.resolve({ needed: 22, per_group: false, source: 'Walter 1998' });
    form.values.value = { ...form.values.value, raters: 3 };
    form.choose('agreement');
    await vi.runAllTimersAsync();
    expect(form.answer.value?.size).toBe('22 sessions, each rated by 3 raters.');
  });

  it('is asked for once after some typing, with shares of one', async () => {
    form.choose('shares');
    await vi.runAllTimersAsync();
    asked = [];
    for (const percent of [5, 55, 57]) form.set('first', percent);
    expect(form.answer.value).toBeNull();
    expect(asked).toEqual([]);
    await vi.runAllTimersAsync();
    expect(asked).toEqual([{ question: 'shares', first: 0.57, second: 0.8, power: 0.8 }]);
  });

  it('leaves to the server to say what is missing', async () => {
    answer = () => Promise.reject(new ApiError('effect is missing', 422));
    form.set('effect', NaN);
    await vi.runAllTimersAsync();
    expect(asked).toEqual([{ question: 'means', power: 0.8 }]);
    expect([form.answer.value, form.problem.value]).toEqual([null, 'effect is missing']);
    form.set('effect', 1);
    expect(form.problem.value).toBeNull();
  });

  it('is never that of an earlier question', async () => {
    const waiting: ((size: SampleSize) => void)[] = [];
    answer = () => new Promise((resolve) => waiting.push(resolve));
    const first = form.ask();
    const second = form.ask();
    waiting[1]?.({ needed: 2, per_group: true, source: 'b' });
    await second;
    waiting[0]?.({ needed: 1, per_group: true, source: 'a' });
    await first;
    expect(form.answer.value?.source).toBe('b');
    form.set('effect', 2);
    form.dispose();
    await vi.runAllTimersAsync();
    expect(waiting).toHaveLength(2);
  });

  it('starts from numbers that can be', () => {
    for (const question of Object.keys(fieldsOf) as SampleQuestion[])
      for (const field of fieldsOf[question]) {
        const { min, max } = rangeOf[field];
        expect(form.values.value[field]).toBeGreaterThanOrEqual(min);
        expect(form.values.value[field]).toBeLessThanOrEqual(max);
      }
  });
});
