import { computed, type ReadonlySignal } from '@preact/signals';

import type { PracticeStore } from './practice_store';
import { type Route } from './route';
import type { Store } from './store';

/**
 * Whether this page is the trainee's in theatre: the session says so and lives, and this page steers it or is the
 * trainee's view of it. Who only watches sees everything.
 */
export function theatreHere(
  store: Store,
  practice: PracticeStore,
  route: ReadonlySignal<Route>,
): ReadonlySignal<boolean> {
  return computed(() => {
    const session = store.watched.value;
    if (session?.theatre !== true || store.replaying.value) return false;
    if (!store.active.value && store.sessionState.value !== 'created') return false;
    return route.value.kind === 'trainee' || practice.sessionId.value === session.id;
  });
}
