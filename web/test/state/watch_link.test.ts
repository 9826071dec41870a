import { describe, expect, it } from 'vitest';

import { addressOfLink, linkInAddress } from '../../src/state/watch_link';

describe('viewer link', () => {
  it('carries its secret where no server and no log sees it, there and back', () => {
    const address = addressOfLink('https://reamer.example', 'ream_ab12_x-Y_z0');
    expect(new URL(address).pathname + new URL(address).search).toBe('/');
    expect(linkInAddress(new URL(address).hash)).toBe('ream_ab12_x-Y_z0');
  });
  it('is nothing else', () => {
    for (const hash of [
      '',
      '#watch=',
      '#watch=short',
      '#replay=abcd1234',
      '#/cases',
      '#watch=a b c d e f g h',
      '#x&watch=12345678',
    ])
      expect(linkInAddress(hash)).toBeNull();
  });
});
