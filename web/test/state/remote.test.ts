import { describe, expect, it } from 'vitest';

import { Remote } from '../../src/state/remote';

describe('Remote', () => {
  let fails = false;
  const remote = () => new Remote(() => (fails ? Promise.reject(new Error('away')) : Promise.resolve('read')));
  const refused = () => Promise.reject(new Error('refused'));

  it('keeps what was read last while reading fails, and says so until it succeeds', async () => {
    const one = remote();
    await one.read();
    fails = true;
    await one.read();
    expect([one.value.value, one.problem.value, one.stale.value]).toEqual(['read', 'away', true]);
    fails = false;
    await one.read();
    expect([one.value.value, one.problem.value, one.stale.value]).toEqual(['read', null, false]);
  });

  it('says why a deed failed until the next deed, however often it reads meanwhile', async () => {
    const one = remote();
    expect(await one.act(refused)).toBeNull();
    await one.read();
    expect([one.problem.value, one.stale.value]).toEqual(['refused', false]);
    expect(await one.act(() => Promise.resolve('done'))).toBe('done');
    expect(one.problem.value).toBeNull();
  });
});
