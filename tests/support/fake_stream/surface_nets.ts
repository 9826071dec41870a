import { dims, spacingMm, type Point } from './bone';

export const blockEdge = 32;
const unitsPerVoxel = 1024;

export const blockDims: Point = [0, 1, 2].map((i) => Math.ceil((dims[i] ?? 0) / blockEdge)) as Point;

/** Vertices of 8 bytes as on the wire, before encoding. */
export interface BlockMesh {
  vertices: Uint8Array;
  vertexCount: number;
  indices: Uint32Array;
}

const axes = [0, 1, 2] as const;

/** Signed distances at the voxel centres, for the whole grid. */
export class Field {
  readonly values = new Float32Array(dims[0] * dims[1] * dims[2]);

  constructor(private readonly distance: (p: Point) => number) {}

  static at(x: number, y: number, z: number): number {
    return x + dims[0] * (y + dims[1] * z);
  }

  fill(): void {
    for (let z = 0; z < dims[2]; ++z)
      for (let y = 0; y < dims[1]; ++y)
        for (let x = 0; x < dims[0]; ++x)
          this.values[Field.at(x, y, z)] = this.distance([
            (x + 0.5) * spacingMm[0],
            (y + 0.5) * spacingMm[1],
            (z + 0.5) * spacingMm[2],
          ]);
  }

  /** Positive (outside) beyond the grid. */
  get(x: number, y: number, z: number): number {
    if (x < 0 || y < 0 || z < 0 || x >= dims[0] || y >= dims[1] || z >= dims[2]) return 1;
    return this.values[Field.at(x, y, z)] ?? 1;
  }
}

/** Naive surface nets of one block: a vertex in each cell that the surface passes, a quad around each edge it crosses. */
export function meshBlock(field: Field, block: number): BlockMesh {
  const origin: Point = [
    (block % blockDims[0]) * blockEdge,
    (Math.floor(block / blockDims[0]) % blockDims[1]) * blockEdge,
    Math.floor(block / (blockDims[0] * blockDims[1])) * blockEdge,
  ];
  const bytes: number[] = [];
  const indices: number[] = [];
  const vertexOfCell = new Map<string, number>();

  const vertex = (cell: Point): number => {
    const key = cell.join();
    const known = vertexOfCell.get(key);
    if (known !== undefined) return known;
    const index = vertexOfCell.size;
    vertexOfCell.set(key, index);
    pushVertex(bytes, field, cell, origin);
    return index;
  };
  const end = origin.map((o, i) => Math.min(o + blockEdge, dims[i] ?? 0)) as Point;
  for (let z = origin[2]; z < end[2]; ++z)
    for (let y = origin[1]; y < end[1]; ++y)
      for (let x = origin[0]; x < end[0]; ++x)
        for (const axis of axes) pushQuad(indices, field, [x, y, z], axis, vertex);
  return { vertices: Uint8Array.from(bytes), vertexCount: vertexOfCell.size, indices: Uint32Array.from(indices) };
}

/** The quad around the edge from voxel `at` to its neighbour along `axis`. */
function pushQuad(indices: number[], field: Field, at: Point, axis: 0 | 1 | 2, vertex: (cell: Point) => number): void {
  const next: Point = [...at];
  next[axis] += 1;
  const inside = field.get(...at) < 0;
  if (inside === field.get(...next) < 0) return;
  const b = ((axis + 1) % 3) as 0 | 1 | 2;
  const c = ((axis + 2) % 3) as 0 | 1 | 2;
  const corner = (db: number, dc: number): number => {
    const cell: Point = [...at];
    cell[b] -= db;
    cell[c] -= dc;
    return vertex(cell);
  };
  const [q0, q1, q2, q3] = [corner(1, 1), corner(0, 1), corner(0, 0), corner(1, 0)];
  indices.push(...(inside ? [q0, q1, q2, q0, q2, q3] : [q0, q2, q1, q0, q3, q2]));
}

function pushVertex(bytes: number[], field: Field, cell: Point, origin: Point): void {
  const sum = [0, 0, 0];
  const gradient = [0, 0, 0];
  let crossings = 0;
  for (let corner = 0; corner < 8; ++corner) {
    const from: Point = [corner & 1, (corner >> 1) & 1, corner >> 2];
    const value = field.get(cell[0] + from[0], cell[1] + from[1], cell[2] + from[2]);
    for (const axis of axes) {
      gradient[axis] = (gradient[axis] ?? 0) + (from[axis] === 1 ? value : -value);
      if (from[axis] === 1) continue;
      const to: Point = [...from];
      to[axis] = 1;
      const other = field.get(cell[0] + to[0], cell[1] + to[1], cell[2] + to[2]);
      if (value < 0 === other < 0) continue;
      ++crossings;
      for (const i of axes) sum[i] = (sum[i] ?? 0) + from[i] + (i === axis ? value / (value - other) : 0);
    }
  }
  for (const axis of axes) {
    const voxels = cell[axis] + 0.5 + (sum[axis] ?? 0) / crossings - (origin[axis] - 1);
    const units = Math.round(voxels * unitsPerVoxel);
    bytes.push(units & 255, units >> 8);
  }
  bytes.push(...octahedral(gradient as Point));
}

/** Two signed bytes, as unsigned. */
function octahedral([x, y, z]: Point): [number, number] {
  const sum = Math.abs(x) + Math.abs(y) + Math.abs(z) || 1;
  let u = x / sum;
  let v = y / sum;
  if (z < 0) [u, v] = [(1 - Math.abs(v)) * (u < 0 ? -1 : 1), (1 - Math.abs(u)) * (v < 0 ? -1 : 1)];
  return [Math.round(u * 127) & 255, Math.round(v * 127) & 255];
}
