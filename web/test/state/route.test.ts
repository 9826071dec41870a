import { describe, expect, it } from 'vitest';

import { addressOfRoute, routeInAddress } from '../../src/state/route';

describe('route', () => {
  it('is the live page for its own addresses, replays among them', () => {
    for (const hash of ['', '#', '#replay=abcd1234', '#/nowhere', '#/cases/Not An Id', '#/cases/../x'])
      expect(routeInAddress(hash)).toEqual({ kind: 'live' });
  });

  it('names the list and one case, there and back', () => {
    expect(routeInAddress('#/cases')).toEqual({ kind: 'cases' });
    expect(routeInAddress('#/cases/')).toEqual({ kind: 'cases' });
    expect(routeInAddress('#/cases/shoulder-right-2')).toEqual({ kind: 'case', id: 'shoulder-right-2' });
    for (const hash of ['#/cases', '#/cases/a1']) expect(addressOfRoute(routeInAddress(hash))).toBe(hash);
  });

  it('names the other pages, there and back', () => {
    for (const hash of [
      '#/',
      '#/sessions',
      '#/studies',
      '#/studies/s1',
      '#/studies/s1/answers/K7-F3M',
      '#/studies/s1/rate',
      '#/rubrics',
      '#/rubrics/house-2',
      '#/benchmarks',
      '#/users',
      '#/trash',
      '#/audit',
      '#/account',
    ]) {
      expect(routeInAddress(hash).kind).not.toBe('live');
      expect(addressOfRoute(routeInAddress(hash))).toBe(hash);
    }
    for (const hash of [
      '#/constructor',
      '#/users/x',
      '#/benchmarks/x',
      '#/rubrics/a/answers/K7-F3M',
      '#/cases/a/answers/K7-F3M',
      '#/studies/s1/answers/k7-f3m',
    ])
      expect(routeInAddress(hash)).toEqual({ kind: 'live' });
  });

  it('names the review of one session or of two, there and back', () => {
    expect(routeInAddress('#/review/ab12cd')).toEqual({ kind: 'review', id: 'ab12cd', beside: null });
    expect(routeInAddress('#/review/ab12cd/')).toEqual({ kind: 'review', id: 'ab12cd', beside: null });
    expect(routeInAddress('#/review/ab12cd/ef34gh')).toEqual({ kind: 'review', id: 'ab12cd', beside: 'ef34gh' });
    for (const hash of ['#/review/ab12cd', '#/review/ab12cd/ef34gh'])
      expect(addressOfRoute(routeInAddress(hash))).toBe(hash);
    for (const hash of ['#/review', '#/review/', '#/review/AB', '#/review/ab12cd/ef34gh/ij56', '#/review/../ab12'])
      expect(routeInAddress(hash)).toEqual({ kind: 'live' });
  });
});
