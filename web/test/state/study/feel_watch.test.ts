import { signal } from '@preact/signals';
import { beforeEach, describe, expect, it } from 'vitest';

import { PracticeStore } from '../../../src/state/practice_store';
import type { Route } from '../../../src/state/route';
import { Store } from '../../../src/state/store';
import { FeelWatch } from '../../../src/state/study/feel_watch';
import { ApiError } from '../../../src/wire/rest';
import type { Session, Study } from '../../../src/wire/rest_types';
import { someSession } from '../../wire/some_answers';

const feel: Study['feel'] = { comparisons: ['density'], trials_per_comparison: 2 };

describe('a session of a study of feel', () => {
  let store: Store;
  let practice: PracticeStore;
  let asked: string[];
  let answer: () => Promise<Pick<Study, 'feel'>>;
  const route = signal<Route>({ kind: 'live' });
  const may = { takePart: true, teach: false };

  beforeEach(() => {
    store = new Store();
    practice = new PracticeStore(store);
    asked = [];
    answer = () => Promise.resolve({ feel });
    route.value = { kind: 'live' };
    Object.assign(may, { takePart: true, teach: false });
  });

  async function watch(changes: Partial<Session> = {}): Promise<FeelWatch> {
    const here = new FeelWatch({
      ...{ store, practice, route, may: () => may },
      study: (id) => {
        asked.push(id);
        return answer();
      },
    });
    store.sessionId.value = 'abcd';
    store.sessionState.value = 'stopped';
    store.details.value = someSession({ study: 's', theatre: true, state: 'stopped', ...changes });
    await Promise.resolve();
    await new Promise((done) => setTimeout(done));
    return here;
  }

  it('is hidden from participants, also before it is known what the study is', async () => {
    answer = () => new Promise(() => undefined);
    const here = await watch();
    expect(here.hidden.value?.id).toBe('abcd');
    expect(asked).toEqual(['s']);
    store.sessionState.value = 'created';
    expect(here.hidden.value).toBeNull();
  });

  it('is hidden from staff where they ran it', async () => {
    may.teach = true;
    const here = await watch();
    expect(here.hidden.value).toBeNull();
    practice.lastSessionId.value = 'abcd';
    expect(here.hidden.value?.id).toBe('abcd');
    practice.lastSessionId.value = 'other';
    route.value = { kind: 'trainee' };
    expect(here.hidden.value?.id).toBe('abcd');
  });

  it('is shown to who watches by a link that staff gave them', async () => {
    may.takePart = false;
    expect((await watch()).hidden.value).toBeNull();
  });

  it('is not one without theatre, of no study, or of a study of scores', async () => {
    expect((await watch({ theatre: false })).hidden.value).toBeNull();
    expect((await watch({ study: null })).hidden.value).toBeNull();
    expect(asked).toEqual([]);
    answer = () => Promise.resolve({ feel: null });
    expect((await watch()).hidden.value).toBeNull();
  });

  it('is asked about once; again where nobody answered', async () => {
    answer = () => Promise.reject(new ApiError('away', 0));
    const here = await watch();
    expect(here.hidden.value?.id).toBe('abcd');
    answer = () => Promise.reject(new ApiError('not yours', 403));
    store.details.value = someSession({ study: 's', theatre: true, state: 'stopped' });
    await new Promise((done) => setTimeout(done));
    expect(here.hidden.value).toBeNull();
    store.details.value = someSession({ study: 's', theatre: true, state: 'stopped' });
    await new Promise((done) => setTimeout(done));
    expect(asked).toEqual(['s', 's']);
  });
});
