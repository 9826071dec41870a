import { signal } from '@preact/signals';
import { describe, expect, it } from 'vitest';

import { PracticeStore } from '../../src/state/practice_store';
import type { Route } from '../../src/state/route';
import { Store } from '../../src/state/store';
import { theatreHere } from '../../src/state/theatre';
import type { Session } from '../../src/wire/rest_types';
import { someSession } from '../wire/some_answers';

const session = (changes: Partial<Session> = {}) => someSession({ id: 'a', ...changes });

function place() {
  const store = new Store();
  const practice = new PracticeStore(store);
  const route = signal<Route>({ kind: 'live' });
  store.sessionId.value = 'a';
  store.sessionState.value = 'running';
  return { store, practice, route, here: theatreHere(store, practice, route) };
}

describe('theatre mode', () => {
  it('is where the reamer of such a session is held, and in the trainee’s view of it', () => {
    const { store, practice, route, here } = place();
    store.details.value = session({ theatre: true });
    expect(here.value).toBe(false);
    practice.sessionId.value = 'a';
    expect(here.value).toBe(true);
    practice.sessionId.value = null;
    route.value = { kind: 'trainee' };
    expect(here.value).toBe(true);
  });

  it('ends with the session, and is not in its replay', () => {
    const { store, route, here } = place();
    store.details.value = session({ theatre: true });
    route.value = { kind: 'trainee' };
    store.sessionState.value = 'stopped';
    expect(here.value).toBe(false);
    store.sessionState.value = 'running';
    store.replayId.value = 'r';
    expect(here.value).toBe(false);
  });

  it('is nowhere where the session does not say so', () => {
    const { store, practice, here } = place();
    practice.sessionId.value = 'a';
    store.sessions.value = [session({ theatre: false })];
    expect(here.value).toBe(false);
    store.sessions.value = [session({ theatre: true })];
    expect(here.value).toBe(true);
  });
});
