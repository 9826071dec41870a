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
});
