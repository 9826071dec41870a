import { describe, expect, it, vi } from 'vitest';

import { CasePlans } from '../../../src/state/case/case_plans';
import type { Case, CaseSummary } from '../../../src/wire/rest_types';

const summary = (id: string, planned = true) => ({ id, planned }) as CaseSummary;
const details = (depth_mm: number) => ({ plan: { depth_mm } }) as Case;

describe('plans in the list of cases', () => {
  it('are read once for each case that has one, and anew when they may have changed', async () => {
    const read = vi.fn((id: string) => Promise.resolve(details(id === 'a' ? 1 : 2)));
    const plans = new CasePlans({ case: read });
    const cases = [summary('a'), summary('b'), summary('c', false)];
    await plans.read(cases);
    await plans.read(cases);
    expect(read.mock.calls).toEqual([['a'], ['b']]);
    expect(Object.entries(plans.plans.value).map(([id, { depth_mm }]) => [id, depth_mm])).toEqual([
      ['a', 1],
      ['b', 2],
    ]);
    plans.forget();
    await plans.read(cases);
    expect(read).toHaveBeenCalledTimes(4);
  });

  it('leave out a case that cannot be read, until the list is read again', async () => {
    const read = vi.fn((id: string) => (id === 'a' ? Promise.reject(new Error('away')) : Promise.resolve(details(2))));
    const plans = new CasePlans({ case: read });
    await plans.read([summary('a'), summary('b')]);
    expect(Object.keys(plans.plans.value)).toEqual(['b']);
    read.mockImplementation(() => Promise.resolve(details(1)));
    await plans.read([summary('a'), summary('b')]);
    expect(Object.keys(plans.plans.value).sort()).toEqual(['a', 'b']);
  });
});
