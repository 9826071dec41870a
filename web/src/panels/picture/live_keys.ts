import { useEffect } from 'preact/hooks';

/** Keys that go on while they are held. */
const repeating = new Set(['[', ']']);

/** Keys that work wherever nobody writes, by their lower-case names; none may be one of the practising hand's. */
export function useLiveKeys(actions: Readonly<Record<string, () => void>>): void {
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (event.defaultPrevented || event.ctrlKey || event.altKey || event.metaKey || writes(event.target)) return;
      const action = actions[event.key.toLowerCase()];
      if (action === undefined) return;
      event.preventDefault();
      if (!event.repeat || repeating.has(event.key)) action();
    };
    document.addEventListener('keydown', onKey);
    return () => document.removeEventListener('keydown', onKey);
  }, [actions]);
}

function writes(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return !['range', 'checkbox', 'radio', 'button'].includes(target.type);
  return target instanceof HTMLElement && target.matches('select, textarea, [contenteditable]');
}
