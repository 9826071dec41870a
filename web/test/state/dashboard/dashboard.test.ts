import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { Dashboard } from '../../../src/state/dashboard/dashboard';
import type { Learning, Session } from '../../../src/wire/rest_types';
import type { ChangeHandlers } from '../../../src/wire/change_socket';
import type { DashboardApi, Learner } from '../../../src/wire/dashboard_api';
import { ApiError } from '../../../src/wire/rest';
import { someDevice, someSession } from '../../wire/some_answers';

const ended = (id: string, traineeId: string) =>
  someSession({ id, trainee_id: traineeId, trainee: traineeId, device: someDevice('browser') });

describe('Dashboard', () => {
  let requests: Learner[];
  let list: Session[];
  let fails: boolean;
  let handlers: ChangeHandlers;
  let dashboard: Dashboard;
  let leave: () => void = () => undefined;
  const settle = () => vi.advanceTimersByTimeAsync(400);

  beforeEach(() => {
    vi.useFakeTimers();
    requests = [];
    list = [ended('2', 'tom'), ended('1', 'ada')];
    fails = false;
    const answer = <T>(value: T): Promise<T> =>
      fails ? Promise.reject(new ApiError('the database is away', 503)) : Promise.resolve(value);
    const api = {
      live: () => answer([]),
      ended: () => answer(list),
      learning: (learner: Learner) => {
        requests.push(learner);
        return answer({ sessions: [] } as unknown as Learning);
      },
    } as unknown as DashboardApi;
    dashboard = new Dashboard(api, 'http://lab', (given) => {
      handlers = given;
      return { start: () => undefined, stop: () => undefined };
    });
  });
  afterEach(() => {
    leave();
    vi.useRealTimers();
  });

  it('shows the learning of whoever trained last, and of whom is chosen', async () => {
    leave = dashboard.follow(false);
    await settle();
    expect(requests).toEqual([{ trainee: 'tom', participant: undefined }]);
    dashboard.choose('trainee ada');
    expect(dashboard.learning.value.value).toBeNull();
    await settle();
    expect(requests.at(-1)?.trainee).toBe('ada');
    expect(dashboard.learner.value?.name).toBe('ada');
  });

  it('asks for a trainee’s own learning without a name, and offers nobody else’s', async () => {
    leave = dashboard.follow(true);
    await settle();
    expect(requests).toEqual([{}]);
    expect(dashboard.learners.value).toEqual([]);
  });

  it('reads what has ended again when a session changes, but not for what only goes on', async () => {
    leave = dashboard.follow(false);
    await settle();
    list = [ended('3', 'eve'), ...list];
    handlers.onChange({ kind: 'session', number: 5, id: '3', change: 'running' });
    await settle();
    expect(dashboard.learner.value?.name).toBe('tom');
    handlers.onChange({ kind: 'session', number: 6, id: '3', change: 'finished' });
    await settle();
    expect(dashboard.learner.value?.name).toBe('eve');
  });

  it('says in words that the server cannot tell, and keeps what it knew as of before', async () => {
    leave = dashboard.follow(false);
    await settle();
    fails = true;
    handlers.onLost();
    handlers.onChange({ kind: 'missed', number: 9 });
    await settle();
    expect(dashboard.board.problem.value).toBe('the database is away');
    expect(dashboard.ended.problem.value).toBe('the database is away');
    expect(dashboard.ended.stale.value).toBe(true);
    expect(dashboard.ended.value.value).toHaveLength(2);
  });
});
