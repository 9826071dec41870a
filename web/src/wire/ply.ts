import { problemText } from './problem_text';

/** Triangles with normals; lengths mm. */
export interface Surface {
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  indices: Uint32Array<ArrayBuffer>;
  low: [number, number, number];
  high: [number, number, number];
}

/**
 * Reads a binary little-endian PLY of vertices x y z nx ny nz (float) and triangles (list uchar int vertex_indices).
 * Throws an Error that says what is wrong with it.
 */
export function readPly(bytes: ArrayBuffer): Surface {
  const header = readHeader(bytes);
  const { vertices, triangles, bodyAt } = header;
  const vertexBytes = vertices * 24;
  const triangleBytes = triangles * 13;
  if (bytes.byteLength < bodyAt + vertexBytes + triangleBytes) throw new Error(problemText.surface.cutShort);
  const view = new DataView(bytes, bodyAt);
  const positions = new Float32Array(vertices * 3);
  const normals = new Float32Array(vertices * 3);
  const low: Surface['low'] = [Infinity, Infinity, Infinity];
  const high: Surface['high'] = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < vertices; ++i) {
    for (const k of [0, 1, 2] as const) {
      const value = view.getFloat32(i * 24 + k * 4, true);
      positions[i * 3 + k] = value;
      normals[i * 3 + k] = view.getFloat32(i * 24 + 12 + k * 4, true);
      if (value < low[k]) low[k] = value;
      if (value > high[k]) high[k] = value;
    }
  }
  const indices = new Uint32Array(triangles * 3);
  for (let i = 0; i < triangles; ++i) {
    const at = vertexBytes + i * 13;
    if (view.getUint8(at) !== 3) throw new Error(problemText.surface.noTriangles);
    for (let k = 0; k < 3; ++k) {
      const index = view.getUint32(at + 1 + k * 4, true);
      if (index >= vertices) throw new Error(problemText.surface.noCorner);
      indices[i * 3 + k] = index;
    }
  }
  return { positions, normals, indices, low, high };
}

const headerMax = 4096;

function readHeader(bytes: ArrayBuffer): { vertices: number; triangles: number; bodyAt: number } {
  const text = new TextDecoder('latin1').decode(new Uint8Array(bytes, 0, Math.min(bytes.byteLength, headerMax)));
  const end = /^end_header\r?\n/m.exec(text);
  if (!text.startsWith('ply') || end === null) throw new Error(problemText.surface.noPly);
  const head = text.slice(0, end.index);
  if (!/^format binary_little_endian/m.test(head)) throw new Error(problemText.surface.noPly);
  const properties = [...head.matchAll(/^property float(?:32)? (\w+)/gm)].map((found) => found[1]).join(' ');
  if (properties !== 'x y z nx ny nz') throw new Error(problemText.surface.corners(properties));
  const count = (what: string) => Number(new RegExp(`^element ${what} (\\d+)`, 'm').exec(head)?.[1] ?? 0);
  return { vertices: count('vertex'), triangles: count('face'), bodyAt: end.index + end[0].length };
}
