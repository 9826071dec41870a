import { effect, type ReadonlySignal, signal } from '@preact/signals';

/**
 * Follows `source` at once where it had rested, else at most every `everyMs`, and always to where it comes to rest. What
 * is `urgent` is never late.
 */
export function throttled<T>(
  source: ReadonlySignal<T>,
  everyMs: number,
  urgent: (value: T) => boolean,
): ReadonlySignal<T> {
  const shown = signal(source.peek());
  let shownAtMs = -Infinity;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const show = () => {
    clearTimeout(timer);
    timer = undefined;
    shownAtMs = performance.now();
    shown.value = source.peek();
  };
  effect(() => {
    const value = source.value;
    if (value === shown.peek()) return;
    const waitMs = shownAtMs + everyMs - performance.now();
    if (waitMs <= 0 || urgent(value)) show();
    else timer ??= setTimeout(show, waitMs);
  });
  return shown;
}
