import { describe, expect, it } from 'vitest';

import { FakeCt, surfacePly } from '../../../tests/support/fake_case/ct';
import { readPly } from '../../src/wire/ply';

/** A triangle, with whatever header lines. */
function ply(lines: string[], index = 2): ArrayBuffer {
  const head = Buffer.from(['ply', ...lines, 'end_header\n'].join('\n'));
  const corners = Buffer.from(Float32Array.from([0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 1, 0, 3, 0, 0, 0, 1]).buffer);
  const face = Buffer.alloc(13);
  face.writeUInt8(3, 0);
  [0, 1, index].forEach((corner, i) => face.writeInt32LE(corner, 1 + i * 4));
  const whole = Buffer.concat([head, corners, face]);
  return whole.buffer.slice(whole.byteOffset, whole.byteOffset + whole.length);
}
const good = [
  'format binary_little_endian 1.0',
  'comment made by hand',
  'element vertex 3',
  ...['x', 'y', 'z', 'nx', 'ny', 'nz'].map((name) => `property float ${name}`),
  'element face 1',
  'property list uchar int vertex_indices',
];

const changed = (line: number, text: string) => good.map((old, i) => (i === line ? text : old));

describe('readPly', () => {
  it('reads corners, normals, triangles and the box around them', () => {
    const surface = readPly(ply(good));
    expect([...surface.positions]).toEqual([0, 0, 0, 2, 0, 0, 0, 3, 0]);
    expect([...surface.normals]).toEqual([0, 0, 1, 0, 0, 1, 0, 0, 1]);
    expect([...surface.indices]).toEqual([0, 1, 2]);
    expect([surface.low, surface.high]).toEqual([
      [0, 0, 0],
      [2, 3, 0],
    ]);
  });

  it('refuses what it cannot show', () => {
    expect(() => readPly(new ArrayBuffer(8))).toThrow('wrong format');
    expect(() => readPly(ply(changed(0, 'format ascii 1.0')))).toThrow('wrong format');
    expect(() => readPly(ply(changed(2, 'element vertex 3000')))).toThrow('incomplete');
    expect(() => readPly(ply(changed(3, 'property float r')))).toThrow('unexpected columns');
    expect(() => readPly(ply(good, 9))).toThrow('missing points');
  });

  it('reads a closed surface', () => {
    const bytes = surfacePly(new FakeCt().labels(226));
    const surface = readPly(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length) as ArrayBuffer);
    const volume = signedVolume(surface.positions, surface.indices);
    expect(surface.indices.length).toBeGreaterThan(10_000);
    expect(volume).toBeGreaterThan(15_000);
  });
});

function signedVolume(p: Float32Array, indices: Uint32Array): number {
  let sum = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a = 0, b = 0, c = 0] = [...indices.subarray(i, i + 3)].map((corner) => corner * 3);
    const at = (corner: number, k: number) => p[corner + k] ?? 0;
    sum +=
      at(a, 0) * (at(b, 1) * at(c, 2) - at(b, 2) * at(c, 1)) +
      at(a, 1) * (at(b, 2) * at(c, 0) - at(b, 0) * at(c, 2)) +
      at(a, 2) * (at(b, 0) * at(c, 1) - at(b, 1) * at(c, 0));
  }
  return sum / 6;
}
