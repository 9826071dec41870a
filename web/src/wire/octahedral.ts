/**
 * Unit vector of an octahedral pair in [-1, 1] (Cigolle et al. 2014): the lower half of the octahedron is folded over
 * the upper.
 */
export function octahedralToUnit(u: number, v: number): [number, number, number] {
  const z = 1 - Math.abs(u) - Math.abs(v);
  const fold = Math.max(-z, 0);
  const x = u + (u >= 0 ? -fold : fold);
  const y = v + (v >= 0 ? -fold : fold);
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

/**
 * Normals of meshopt-decoded vertices (8 bytes each, the octahedral pair as s8 in bytes 6 and 7) as four s16 per
 * vertex. Positions stay in voxels and are stretched by the voxel spacing when drawn, which divides normals by it; so
 * they are multiplied by the spacing here, and come out unit vectors of the grid frame in mm.
 */
export function stretchedNormals(
  vertices: Uint8Array,
  vertexCount: number,
  spacingMm: readonly [number, number, number],
): Int16Array<ArrayBuffer> {
  const bytes = new Int8Array(vertices.buffer, vertices.byteOffset, vertices.byteLength);
  const normals = new Int16Array(vertexCount * 4);
  const largest = Math.max(...spacingMm);
  const scale = spacingMm.map((s) => (32767 * s) / largest) as [number, number, number];
  for (let i = 0; i < vertexCount; ++i) {
    const u = Math.max((bytes[8 * i + 6] ?? 0) / 127, -1);
    const v = Math.max((bytes[8 * i + 7] ?? 0) / 127, -1);
    const [x, y, z] = octahedralToUnit(u, v);
    normals[4 * i] = Math.round(x * scale[0]);
    normals[4 * i + 1] = Math.round(y * scale[1]);
    normals[4 * i + 2] = Math.round(z * scale[2]);
  }
  return normals;
}
