import { describe, expect, it } from 'vitest';

import { curveOfSessions, scaleFor } from '../../../src/state/dashboard/curve';
import { learnersIn } from '../../../src/state/dashboard/learners';
import type { Session } from '../../../src/wire/rest_types';
import { someDevice, someSession } from '../../wire/some_answers';

const of = (id: string, who: Partial<Session>) =>
  someSession({ id, created_utc: id, device: someDevice('browser'), ...who });

describe('learnersIn', () => {
  it('names trainees, knows those of studies by code alone, and leaves out who is neither', () => {
    const found = learnersIn([
      of('5', { participant: 'K7-F3M', trainee: 'K7-F3M', trainee_id: null }),
      of('4', { trainee_id: 'u1', trainee: 'Tom' }),
      of('3', {}),
      of('2', { trainee_id: 'u2', trainee: null }),
      of('1', { trainee_id: 'u1', trainee: 'Tom' }),
      of('0', { trainee_id: 'u3', trainee: 'Only demos', device: someDevice('script') }),
    ]);
    expect(found.map(({ name, sessions }) => [name, sessions])).toEqual([
      ['K7-F3M', 1],
      ['Tom', 2],
      ['u2', 1],
    ]);
    expect(found.map(({ trainee, participant }) => trainee ?? participant)).toEqual(['K7-F3M', 'u1', 'u2']);
    expect(found[0]?.trainee).toBeUndefined();
  });
});

describe('curves', () => {
  it('go from the oldest session to the newest', () => {
    const score = { points: 80, outcome: 'pass', rubric: 'Standard', version: 1 } as const;
    const curve = curveOfSessions([
      of('2', { score }),
      of('1', { score: null }),
      of('0', { score, device: someDevice('script') }),
    ]);
    expect(curve.map(({ session, points, outcome }) => [session, points, outcome])).toEqual([
      ['1', null, null],
      ['2', 80, 'pass'],
    ]);
  });

  it('have limits and values within their scale', () => {
    const { low, high } = scaleFor([3], [-2.24, 2.24, 0]);
    expect(low).toBeLessThan(-2.24);
    expect(high).toBeGreaterThan(3);
  });
});
