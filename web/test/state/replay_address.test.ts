import { describe, expect, it } from 'vitest';

import { addressOfReplay, replayInAddress } from '../../src/state/replay_address';

describe('address of a replay', () => {
  it('is read as it is written', () => {
    expect(replayInAddress(addressOfReplay('rk7m2abcd'))).toBe('rk7m2abcd');
    expect(addressOfReplay(null)).toBe('');
    expect(replayInAddress('')).toBeNull();
  });
  it('takes only ids', () => {
    for (const hash of ['#replay=', '#replay=../x', '#replay=AB12', '#session=abcd', '#replay=abcd&x'])
      expect(replayInAddress(hash)).toBeNull();
  });
});
