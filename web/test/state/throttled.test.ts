import { effect, signal } from '@preact/signals';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';

import { throttled } from '../../src/state/throttled';

const everyMs = 100;

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function followed(source: ReturnType<typeof signal<number>>) {
  const seen: number[] = [];
  const shown = throttled(source, everyMs, (value) => value === 0);
  effect(() => void seen.push(shown.value ?? NaN));
  return seen;
}

it('shows at once what comes after a rest', () => {
  const source = signal<number>(1);
  const seen = followed(source);
  source.value = 2;
  expect(seen).toEqual([1, 2]);
});

it('shows of many changes no more than one in each stretch, and the last of them', () => {
  const source = signal<number>(1);
  const seen = followed(source);
  for (let value = 2; value <= 31; ++value) {
    source.value = value;
    vi.advanceTimersByTime(10);
  }
  vi.advanceTimersByTime(everyMs);
  expect(seen.length).toBeLessThanOrEqual(2 + 4);
  expect(seen.at(-1)).toBe(31);
  expect([...seen].sort((a, b) => a - b)).toEqual(seen);
});

it('shows what is urgent at once, and nothing older after it', () => {
  const source = signal<number>(1);
  const seen = followed(source);
  source.value = 2;
  source.value = 3;
  source.value = 0;
  expect(seen).toEqual([1, 2, 0]);
  vi.advanceTimersByTime(10 * everyMs);
  expect(seen).toEqual([1, 2, 0]);
});
