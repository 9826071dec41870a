import type { ToolMesh } from '../wire/messages';

/** A place of a body of revolution: distance from its axis and height along it, mm. */
export interface MeridianPoint {
  offMm: number;
  zMm: number;
}

/** Corners that are closer belong to the same ring around the axis. */
const sameRingMm = 2e-3;
/** A ring has corners in each of so many equal parts of a turn. */
const directions = 24;
const everyDirection = 2 ** directions - 1;
/** A body of revolution has fewer rings; what has more is none, and is not worth looking at further. */
const ringsMost = 2000;

interface Rings {
  points: MeridianPoint[];
  /** The ring of each corner. */
  of: Int32Array;
}

/**
 * The outline of a mesh that is a body of revolution around z, from its highest end to its lowest, both on the axis;
 * null: the mesh is none.
 */
export function meridianOf(tool: ToolMesh): MeridianPoint[] | null {
  const rings = ringsOf(tool.positionsMm);
  if (rings === null) return null;
  const order = inOrder(neighboursOf(rings, tool.indices));
  if (order === null) return null;
  const outline = order.map((ring) => rings.points[ring] as MeridianPoint);
  if ((outline[0]?.zMm ?? 0) < (outline.at(-1)?.zMm ?? 0)) outline.reverse();
  return [onAxis(outline[0]), ...outline.filter(({ offMm }) => offMm > sameRingMm), onAxis(outline.at(-1))];
}

const onAxis = (point: MeridianPoint | undefined): MeridianPoint => ({ offMm: 0, zMm: point?.zMm ?? 0 });

/** Null where there are too many, or some do not go all the way round. */
function ringsOf(positionsMm: Float32Array): Rings | null {
  const of = new Int32Array(positionsMm.length / 3);
  const points: MeridianPoint[] = [];
  const seen: number[] = [];
  const cells = new Map<string, number>();
  for (let i = 0; i < of.length; ++i) {
    const [x, y, zMm] = [positionsMm[3 * i] ?? 0, positionsMm[3 * i + 1] ?? 0, positionsMm[3 * i + 2] ?? 0];
    const offMm = Math.hypot(x, y);
    let ring = ringNear(cells, { offMm, zMm });
    if (ring === undefined) {
      ring = points.push({ offMm, zMm }) - 1;
      if (points.length > ringsMost) return null;
      cells.set(cellOf(offMm, zMm, 0, 0), ring);
    }
    of[i] = ring;
    const part = Math.floor(((Math.atan2(y, x) / (2 * Math.PI) + 1) % 1) * directions) % directions;
    seen[ring] = (seen[ring] ?? 0) | (1 << part);
  }
  const round = points.every(({ offMm }, ring) => offMm <= sameRingMm || seen[ring] === everyDirection);
  return round ? { points, of } : null;
}

const cellOf = (offMm: number, zMm: number, right: number, up: number): string =>
  `${Math.round(offMm / sameRingMm) + right},${Math.round(zMm / sameRingMm) + up}`;

/** What rounds to another cell may still be of the same ring. */
function ringNear(cells: Map<string, number>, { offMm, zMm }: MeridianPoint): number | undefined {
  for (const right of [0, -1, 1])
    for (const up of [0, -1, 1]) {
      const ring = cells.get(cellOf(offMm, zMm, right, up));
      if (ring !== undefined) return ring;
    }
  return undefined;
}

function neighboursOf({ points, of }: Rings, indices: Uint32Array): Set<number>[] {
  const neighbours = points.map(() => new Set<number>());
  const join = (a: number, b: number) => {
    const [one, other] = [of[a] ?? 0, of[b] ?? 0];
    if (one === other) return;
    neighbours[one]?.add(other);
    neighbours[other]?.add(one);
  };
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const [a, b, c] = [indices[i] ?? 0, indices[i + 1] ?? 0, indices[i + 2] ?? 0];
    join(a, b);
    join(b, c);
    join(c, a);
  }
  return neighbours;
}

/** The rings as they follow each other; null where they branch, close on themselves, or are not all joined. */
function inOrder(neighbours: Set<number>[]): number[] | null {
  const ends = neighbours.flatMap(({ size }, ring) => (size === 1 ? [ring] : []));
  if (ends.length !== 2 || neighbours.some(({ size }) => size > 2)) return null;
  const order: number[] = [];
  let [at, from] = [ends[0], undefined as number | undefined];
  while (at !== undefined) {
    order.push(at);
    const next: number | undefined = [...(neighbours[at] ?? [])].find((ring) => ring !== from);
    [from, at] = [at, next];
  }
  return order.length === neighbours.length ? order : null;
}
