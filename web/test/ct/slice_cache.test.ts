import { describe, expect, it, vi } from 'vitest';

import { SliceCache, type SliceKey } from '../../src/ct/slice_cache';

const key = (index: number): SliceKey => ({ of: 'hu', revision: 1, axis: 'w', index });
const fetchOf = (bytes: number) => vi.fn(() => Promise.resolve(new ArrayBuffer(bytes)));

describe('SliceCache', () => {
  it('fetches a slice once, however many ask', async () => {
    const fetchSlice = fetchOf(10);
    const cache = new SliceCache(fetchSlice);
    const [a, b] = await Promise.all([cache.get(key(1)), cache.get(key(1))]);
    expect(a).toBe(b);
    await cache.get(key(1));
    expect(fetchSlice).toHaveBeenCalledTimes(1);
  });

  it('holds no more bytes than it may, and drops what was used longest ago', async () => {
    const cache = new SliceCache(fetchOf(10), 30);
    for (const index of [1, 2, 3]) await cache.get(key(index));
    cache.peek(key(1));
    await cache.get(key(4));
    expect(cache.bytes).toBe(30);
    expect([1, 2, 3, 4].map((index) => cache.peek(key(index)) !== null)).toEqual([true, false, true, true]);
  });

  it('keeps another revision and another kind apart', async () => {
    const cache = new SliceCache(fetchOf(10));
    await cache.get(key(1));
    expect(cache.peek({ ...key(1), revision: 2 })).toBeNull();
    expect(cache.peek({ ...key(1), of: 'labels' })).toBeNull();
    expect(cache.peek({ ...key(1), axis: 'u' })).toBeNull();
  });

  it('asks again for what failed', async () => {
    const fetchSlice = vi
      .fn<() => Promise<ArrayBuffer>>()
      .mockRejectedValueOnce(new Error('gone'))
      .mockResolvedValueOnce(new ArrayBuffer(4));
    const cache = new SliceCache(fetchSlice);
    await expect(cache.get(key(1))).rejects.toThrow('gone');
    await expect(cache.get(key(1))).resolves.toHaveProperty('byteLength', 4);
  });

  it('fetches ahead only a few at a time, and nothing twice', async () => {
    const fetchSlice = fetchOf(10);
    const cache = new SliceCache(fetchSlice, 1000, 4);
    cache.prefetch([1, 2, 3, 4, 5, 6].map(key));
    expect(fetchSlice).toHaveBeenCalledTimes(4);
    await cache.get(key(4));
    cache.prefetch([1, 2, 3, 4].map(key));
    expect(fetchSlice).toHaveBeenCalledTimes(4);
  });

  it('keeps nothing of what was under way when it was cleared', async () => {
    let signal: AbortSignal | undefined;
    const cache = new SliceCache((_key, given) => {
      signal = given;
      return Promise.resolve(new ArrayBuffer(10));
    });
    const waiting = cache.get(key(1));
    cache.clear();
    await waiting;
    expect(signal?.aborted).toBe(true);
    expect(cache.peek(key(1))).toBeNull();
    expect(cache.bytes).toBe(0);
  });
});
