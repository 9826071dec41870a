import { gzipSync } from 'node:zlib';

import { describe, expect, it } from 'vitest';

import { lastAt } from '../../src/review_file/file_replay';
import { readReviewParts } from '../../src/review_file/review_parts';

const u32 = (value: number) => [value & 255, (value >> 8) & 255, (value >> 16) & 255, value >>> 24];
const part = (...bytes: number[]) => [...u32(bytes.length), ...bytes];
const text = (value: string) => [...new TextEncoder().encode(value)];
const facts = part(1, ...text(JSON.stringify({ session: { id: 's-1' }, ticks: 40 })));
const hello = part(2, 1);
const message = (ticks: number, ...bytes: number[]) => part(3, ...u32(ticks), ...bytes);
const tool = (ticks: number, ...bytes: number[]) => part(4, ...u32(ticks), ...bytes);
const map = (which: number, ...bytes: number[]) => part(5, which, ...bytes);

const read = (...parts: number[][]) =>
  readReviewParts(new Uint8Array(gzipSync(Uint8Array.from([...text('reamview'), ...u32(1), ...parts.flat()]))));

describe('The parts of a review file', () => {
  it('are facts, messages and maps', async () => {
    const parts = await read(facts, hello, message(0, 7, 8), tool(250, 6), message(300, 9), map(2, 255, 3));
    expect(parts.facts).toMatchObject({ session: { id: 's-1' }, ticks: 40 });
    expect(parts.telemetry.map(({ atTicks, bytes }) => [atTicks, ...bytes])).toEqual([
      [0, 7, 8],
      [300, 9],
    ]);
    expect([...parts.hello]).toEqual([1]);
    expect(parts.tools.map(({ atTicks, bytes }) => [atTicks, ...bytes])).toEqual([[250, 6]]);
    expect([...parts.maps].map(([name, bytes]) => [name, ...bytes])).toEqual([['wall', -1, 3]]);
  });

  it.each([
    ['without facts', [hello, message(0, 1)]],
    ['without a hello', [facts, message(0, 1)]],
    ['without a message', [facts, hello]],
    ['with a message that is too short', [facts, hello, part(3, 1, 2)]],
    ['with a part of another kind', [facts, hello, message(0, 1), part(9)]],
    ['with facts that are no JSON', [part(1, 123), hello, message(0, 1)]],
  ])('%s are refused', async (_, parts) => {
    await expect(read(...parts)).rejects.toThrow();
  });
});

describe('What holds at a moment', () => {
  it('is the last that began by then', () => {
    const all = [0, 20, 20, 45].map((atTicks, i) => ({ atTicks, i }));
    expect([0, 19, 20, 44, 45, 1e6].map((ticks) => lastAt(all, ticks)?.i)).toEqual([0, 0, 2, 2, 3, 3]);
    expect(lastAt(all, -1)).toBeUndefined();
  });
});
