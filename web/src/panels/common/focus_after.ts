import { type RefObject } from 'preact';
import { useEffect, useRef } from 'preact/hooks';

/**
 * For controls that take each other's place: whichever holds the ref after `change` has changed has the focus then.
 * Not at first, and not when the page is only drawn again.
 */
export function useFocusAfter<T extends HTMLElement>(change: unknown): RefObject<T | null> {
  const held = useRef<T>(null);
  const before = useRef(change);
  useEffect(() => {
    if (before.current !== change) held.current?.focus();
    before.current = change;
  }, [change]);
  return held;
}
