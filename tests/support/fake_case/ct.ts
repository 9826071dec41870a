/** A made-up CT of a right shoulder: ellipsoids of bone in soft tissue, in a volume that lies straight in LPS. */
export type Point = [number, number, number];
export type Axis = 'u' | 'v' | 'w';

export const dims: Point = [112, 120, 80];
export const spacingMm: Point = [1, 1, 1.5];
/** World place of the volume's corner. */
export const originMm: Point = [-160, -60, -70];

interface Body {
  label: number;
  centre: Point;
  radii: Point;
  hu: number;
}

/** World frame, mm; the first that holds a point gives its value. */
const bodies: readonly Body[] = [
  { label: 2, centre: [-128, -2, 0], radii: [23, 23, 24], hu: 420 },
  { label: 2, centre: [-132, 0, -46], radii: [11, 11, 40], hu: 700 },
  { label: 3, centre: [-96, -44, 34], radii: [30, 6, 5], hu: 800 },
  { label: 1, centre: [-97, 0, 0], radii: [6, 13, 18], hu: 650 },
  { label: 1, centre: [-82, 2, -6], radii: [18, 7, 14], hu: 500 },
  { label: 1, centre: [-66, 10, -20], radii: [12, 5, 38], hu: 450 },
  { label: 4, centre: [-60, 6, -40], radii: [4, 40, 5], hu: 600 },
];
const tissue = { centre: [-100, 0, -10] as Point, radii: [58, 56, 80] as Point };

export const truth: Record<string, Point> = {
  glenoid_centre_mm: [-103, 0, 0],
  superior_rim_mm: [-99, 0, 17],
  inferior_rim_mm: [-99, 0, -17],
  anterior_rim_mm: [-99, -12, 0],
  posterior_rim_mm: [-99, 12, 0],
  trigonum_mm: [-57, 10, -8],
  inferior_angle_mm: [-66, 10, -56],
};
export const headTruth = { centre_mm: [-128, -2, 0] as Point, radius_mm: 23 };

function inside(p: Point, centre: Point, radii: Point): boolean {
  return p.reduce((sum, value, i) => sum + ((value - (centre[i] ?? 0)) / (radii[i] ?? 1)) ** 2, 0) <= 1;
}

const worldOf = (i: number, j: number, k: number): Point => [
  originMm[0] + (i + 0.5) * spacingMm[0],
  originMm[1] + (j + 0.5) * spacingMm[1],
  originMm[2] + (k + 0.5) * spacingMm[2],
];

/** HU and the labels of what is at least `thresholdHu`, x fastest. */
export class FakeCt {
  readonly hu = new Int16Array(dims[0] * dims[1] * dims[2]);
  private readonly truth = new Uint8Array(this.hu.length);

  constructor() {
    let noise = 1;
    for (let k = 0, at = 0; k < dims[2]; ++k)
      for (let j = 0; j < dims[1]; ++j)
        for (let i = 0; i < dims[0]; ++i, ++at) {
          const p = worldOf(i, j, k);
          const body = bodies.find(({ centre, radii }) => inside(p, centre, radii));
          noise = (noise * 48271) % 0x7fffffff;
          const base = body?.hu ?? (inside(p, tissue.centre, tissue.radii) ? 40 : -1000);
          this.hu[at] = base + (noise % 41) - 20;
          this.truth[at] = body?.label ?? 0;
        }
  }

  labels(thresholdHu: number): Uint8Array {
    return this.truth.map((label, at) => ((this.hu[at] ?? 0) >= thresholdHu ? label : 0));
  }
}

/** One slice of a volume as the interface sends it. */
export function sliceOf<T extends Int16Array | Uint8Array>(volume: T, axis: Axis, index: number): T {
  const [nx, ny, nz] = dims;
  const [columns, rows] = { u: [ny, nz], v: [nx, nz], w: [nx, ny] }[axis] as [number, number];
  const slice = volume.slice(0, columns * rows) as T;
  for (let row = 0, at = 0; row < rows; ++row)
    for (let column = 0; column < columns; ++column, ++at) {
      const [i, j, k] = { u: [index, column, row], v: [column, index, row], w: [column, row, index] }[axis] as Point;
      slice[at] = volume[i + nx * (j + ny * k)] ?? 0;
    }
  return slice;
}

/** What a segmentation tells of each part. */
export function partsOf(labels: Uint8Array): object[] {
  const names = ['', 'scapula', 'humerus', 'clavicle', 'other'];
  return [1, 2, 3, 4].map((label) => {
    const sum: Point = [0, 0, 0];
    const low: Point = [Infinity, Infinity, Infinity];
    const high: Point = [-Infinity, -Infinity, -Infinity];
    let voxels = 0;
    labels.forEach((value, at) => {
      if (value !== label) return;
      ++voxels;
      const p = worldOf(at % dims[0], Math.floor(at / dims[0]) % dims[1], Math.floor(at / (dims[0] * dims[1])));
      for (const i of [0, 1, 2] as const) {
        sum[i] += p[i];
        low[i] = Math.min(low[i], p[i]);
        high[i] = Math.max(high[i], p[i]);
      }
    });
    const volume_mm3 = voxels * spacingMm[0] * spacingMm[1] * spacingMm[2];
    return {
      label,
      name: names[label],
      voxels,
      volume_mm3,
      centre_mm: sum.map((s) => s / voxels),
      low_mm: low,
      high_mm: high,
    };
  });
}

/** The faces between label 1 and the rest, as a binary PLY in world mm. */
export function surfacePly(labels: Uint8Array): Buffer {
  const vertices: number[] = [];
  const at = (i: number, j: number, k: number) =>
    i < 0 || j < 0 || k < 0 || i >= dims[0] || j >= dims[1] || k >= dims[2]
      ? 0
      : (labels[i + dims[0] * (j + dims[1] * k)] ?? 0);
  for (let k = 0; k < dims[2]; ++k)
    for (let j = 0; j < dims[1]; ++j)
      for (let i = 0; i < dims[0]; ++i) {
        if (at(i, j, k) !== 1) continue;
        for (const axis of [0, 1, 2] as const)
          for (const sign of [-1, 1] as const) {
            const next: Point = [i, j, k];
            next[axis] += sign;
            if (at(...next) !== 1) pushFace(vertices, [i, j, k], axis, sign);
          }
      }
  return plyOf(vertices);
}

function pushFace(vertices: number[], voxel: Point, axis: 0 | 1 | 2, sign: -1 | 1): void {
  const [a, b] = [(axis + 1) % 3, (axis + 2) % 3] as [0 | 1 | 2, 0 | 1 | 2];
  const around =
    sign === 1
      ? [
          [0, 0],
          [1, 0],
          [1, 1],
          [0, 1],
        ]
      : [
          [0, 0],
          [0, 1],
          [1, 1],
          [1, 0],
        ];
  for (const [da = 0, db = 0] of around) {
    const corner: Point = [...voxel];
    corner[axis] += sign === 1 ? 1 : 0;
    corner[a] += da;
    corner[b] += db;
    const normal: Point = [0, 0, 0];
    normal[axis] = sign;
    vertices.push(...corner.map((value, i) => (originMm[i] ?? 0) + value * (spacingMm[i] ?? 1)), ...normal);
  }
}

function plyOf(vertices: readonly number[]): Buffer {
  const count = vertices.length / 6;
  const faces = count / 2;
  const head = [
    'ply',
    'format binary_little_endian 1.0',
    `element vertex ${count}`,
    ...['x', 'y', 'z', 'nx', 'ny', 'nz'].map((name) => `property float ${name}`),
    `element face ${faces}`,
    'property list uchar int vertex_indices',
    'end_header\n',
  ].join('\n');
  const indices = Buffer.alloc(faces * 13);
  for (let face = 0; face < faces; ++face) {
    const first = (face >> 1) * 4;
    const corners = face % 2 === 0 ? [first, first + 1, first + 2] : [first, first + 2, first + 3];
    indices.writeUInt8(3, face * 13);
    corners.forEach((corner, i) => indices.writeInt32LE(corner, face * 13 + 1 + i * 4));
  }
  return Buffer.concat([Buffer.from(head), Buffer.from(Float32Array.from(vertices).buffer), indices]);
}
