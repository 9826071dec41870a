import { type Box3, type BufferGeometry, DoubleSide, type Ray, type Side, Vector3 } from 'three';
import { MeshBVH } from 'three-mesh-bvh';

/** Where a line goes through a triangle. */
export interface LineHit {
  point: Vector3;
  /** Numbers of the triangle's corners. */
  corners: readonly [number, number, number];
}

/** Triangles that lie in a box: so many indices from `start` on. */
export interface GeometryPart {
  start: number;
  count: number;
  box: Box3;
}

const trees = new WeakMap<BufferGeometry, MeshBVH>();
const parts = new WeakMap<BufferGeometry, ReadonlyMap<unknown, GeometryPart>>();

/** Gives a geometry the tree of boxes around its triangles that was made elsewhere. */
export function haveBoxes(geometry: BufferGeometry, roots: ArrayBuffer[]): void {
  const data = { version: 1, roots, index: null, indirectBuffer: null };
  trees.set(geometry, MeshBVH.deserialize(data, geometry, { setIndex: false }));
}

/** Gives a geometry the parts that it is made of; they are looked up anew for every line, and nothing else is met. */
export function haveParts(geometry: BufferGeometry, made: ReadonlyMap<unknown, GeometryPart>): void {
  parts.set(geometry, made);
}

/**
 * Every triangle of a geometry that a line meets, in no order; line and hits are in the geometry's coordinates. A tree is
 * not made for it: of parts those are searched whose box is met, and without parts all triangles are tried.
 */
export function hitsOf(geometry: BufferGeometry, line: Ray, side: Side): LineHit[] {
  const hits: LineHit[] = [];
  const tree = trees.get(geometry);
  if (tree !== undefined) {
    for (const { point, face } of tree.raycast(line, side)) {
      if (face) hits.push({ point: point.clone(), corners: [face.a, face.b, face.c] });
    }
    return hits;
  }
  const all = (geometry.index ?? geometry.getAttribute('position')).count;
  const made = parts.get(geometry);
  if (made === undefined) tryTriangles(geometry, 0, all, line, side, hits);
  for (const { start, count, box } of made?.values() ?? []) {
    if (line.intersectsBox(box)) tryTriangles(geometry, start, count, line, side, hits);
  }
  return hits;
}

function tryTriangles(
  { index, attributes }: BufferGeometry,
  start: number,
  count: number,
  line: Ray,
  side: Side,
  hits: LineHit[],
): void {
  const { position } = attributes;
  if (position === undefined) return;
  const [a, b, c, at] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
  const corner = (i: number) => index?.getX(i) ?? i;
  for (let i = start; i < start + count; i += 3) {
    const corners = [corner(i), corner(i + 1), corner(i + 2)] as const;
    a.fromBufferAttribute(position, corners[0]);
    b.fromBufferAttribute(position, corners[1]);
    c.fromBufferAttribute(position, corners[2]);
    if (line.intersectTriangle(a, b, c, side !== DoubleSide, at) !== null) hits.push({ point: at.clone(), corners });
  }
}
