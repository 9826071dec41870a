import { gzipSync } from 'node:zlib';

import { describe, expect, it } from 'vitest';

import { PartFileError, causeFile, partsOf as readParts } from '../../src/twin/part_file';

const u32 = (value: number) => [value & 255, (value >> 8) & 255, (value >> 16) & 255, value >>> 24];
const head = [...new TextEncoder().encode('reamtwin'), ...u32(1)];
const part = (...bytes: number[]) => [...u32(bytes.length), ...bytes];

/** The file in pieces of so many packed bytes. */
function fileOf(bytes: readonly number[], pieceBytes: number): ReadableStream<Uint8Array<ArrayBuffer>> {
  const packed = new Uint8Array(gzipSync(Uint8Array.from(bytes)));
  return new ReadableStream({
    start(controller) {
      for (let at = 0; at < packed.length; at += pieceBytes) controller.enqueue(packed.slice(at, at + pieceBytes));
      controller.close();
    },
  });
}

async function partsOf(bytes: readonly number[], pieceBytes = 1000): Promise<number[][]> {
  const parts: number[][] = [];
  for await (const each of readParts(causeFile, fileOf(bytes, pieceBytes))) parts.push([...each]);
  return parts;
}

describe('A file of causes', () => {
  it.each([1, 7, 1000])('is taken part by part, whatever pieces of %i bytes it comes in', async (pieceBytes) => {
    const long = Array.from({ length: 300 }, (_, i) => i & 255);
    expect(await partsOf([...head, ...part(1, 2, 3), ...part(), ...part(...long)], pieceBytes)).toEqual([
      [1, 2, 3],
      [],
      long,
    ]);
  });

  it('may have no part', async () => expect(await partsOf(head)).toEqual([]));

  it.each([
    ['cut within a part', [...head, ...part(1, 2, 3).slice(0, -1)]],
    ['cut within a length', [...head, 3, 0]],
    ['cut after a length', [...head, ...u32(3)]],
    ['cut within its head', head.slice(0, 9)],
    ['empty', []],
    ['saying a part of 4 GB', [...head, 255, 255, 255, 255]],
    ['another file', [...new TextEncoder().encode('reamrec\n'), ...u32(4)]],
    ['of another revision', [...head.slice(0, 8), ...u32(2)]],
  ])('that is %s is refused', async (_, bytes) => {
    await expect(partsOf(bytes)).rejects.toThrow(PartFileError);
  });

  it('that is not packed is refused', async () => {
    const plain = new ReadableStream<Uint8Array<ArrayBuffer>>({
      start(controller) {
        controller.enqueue(Uint8Array.from(head));
        controller.close();
      },
    });
    const take = async () => {
      for await (const each of readParts(causeFile, plain)) void each;
    };
    await expect(take()).rejects.toThrow();
  });
});
