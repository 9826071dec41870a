import { describe, expect, it } from 'vitest';

import { addressOfLink, linkInAddress, placeBehindLink } from '../../src/state/watch_link';

describe('viewer link', () => {
  it('carries its secret where no server and no log sees it, there and back', () => {
    const address = addressOfLink('https://reamer.example', 'ream_ab12_x-Y_z0');
    expect(new URL(address).pathname + new URL(address).search).toBe('/');
    expect(linkInAddress(new URL(address).hash)).toBe('ream_ab12_x-Y_z0');
  });
  it('leads to a review where it was made there, and leaves only that in the address', () => {
    const { hash, pathname, search } = new URL(addressOfLink('https://reamer.example', 'ream_ab12_x-Y_z0', 'xpkqq82u'));
    expect(pathname + search).toBe('/');
    expect(linkInAddress(hash)).toBe('ream_ab12_x-Y_z0');
    expect(placeBehindLink(hash)).toBe('#/review/xpkqq82u');
    expect(placeBehindLink('#watch=ream_ab12_x-Y_z0')).toBe('');
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
      '#watch=ream_ab12_x-Y_z0/cases/a',
      '#watch=ream_ab12_x-Y_z0/review/../x',
    ])
      expect(linkInAddress(hash)).toBeNull();
  });
});
