import { afterEach, expect, it, vi } from 'vitest';

import { guardUnsaved, mayLeave } from '../../src/state/unsaved';

afterEach(() => vi.unstubAllGlobals());

it('asks only while something would be lost', () => {
  const listeners = new Map<string, (event: { preventDefault: () => void }) => void>();
  vi.stubGlobal('window', {
    addEventListener: (name: string, listener: () => void) => listeners.set(name, listener),
    removeEventListener: (name: string) => listeners.delete(name),
  });
  expect(mayLeave()).toBe(true);
  let changed = false;
  const ask = vi.fn(() => false);
  const end = guardUnsaved(() => changed, ask);
  expect(mayLeave()).toBe(true);
  changed = true;
  expect(mayLeave()).toBe(false);
  const event = { preventDefault: vi.fn() };
  listeners.get('beforeunload')?.(event);
  expect(event.preventDefault).toHaveBeenCalledOnce();
  ask.mockReturnValue(true);
  expect(mayLeave()).toBe(true);
  end();
  ask.mockReturnValue(false);
  expect(mayLeave()).toBe(true);
  expect(listeners.size).toBe(0);
});
