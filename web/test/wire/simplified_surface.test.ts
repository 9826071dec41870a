import { Triangle, Vector3 } from 'three';
import { beforeAll, describe, expect, it } from 'vitest';

import { goneStep } from '../../src/wire/bone_marks';
import type { BlockSurface } from '../../src/wire/messages';
import type { Triple } from '../../src/wire/pose';
import { simplifiedSurface, simplifiedToMm, simplifierReady } from '../../src/wire/simplified_surface';

const edge = 32;
const spacingMm: Triple = [0.25, 0.25, 0.5];
const ballMm = 25;
const bone = 2;

/** As a block has a unit normal (octahedral). */
const stretched = (normal: Vector3) =>
  normal.toArray().map((part, axis) => Math.round((32767 * part * (spacingMm[axis] ?? 1)) / Math.max(...spacingMm)));

/** A cap of a ball as large as a glenoid's face over a block, one corner a voxel, with the marks that `marks` gives. */
function cap(marks: (x: number, y: number) => number = () => bone): BlockSurface {
  const row = edge + 1;
  const positions = new Uint16Array(4 * row * row);
  const normals = new Int16Array(4 * row * row);
  const indices: number[] = [];
  for (let y = 0; y < row; ++y)
    for (let x = 0; x < row; ++x) {
      const away = new Vector3((x - edge / 2) * spacingMm[0], (y - edge / 2) * spacingMm[1], 0);
      away.z = Math.sqrt(ballMm ** 2 - away.lengthSq());
      const corner = 4 * (x + row * y);
      positions.set([1024 * x, 1024 * y, Math.round((1024 * (away.z - ballMm + 2)) / spacingMm[2])], corner);
      normals.set([...stretched(away.normalize()), marks(x, y)], corner);
      const [a, b, c, d] = [x + row * y, x + 1 + row * y, x + row * (y + 1), x + 1 + row * (y + 1)];
      if (x < edge && y < edge) indices.push(a, b, d, a, d, c);
    }
  return { block: 7, revision: 3, tick: 12, positions, normals, indices: Uint16Array.from(indices) };
}

const cornersOf = ({ positions, normals }: BlockSurface) =>
  Array.from({ length: positions.length / 4 }, (_, i) => ({
    steps: positions.slice(4 * i, 4 * i + 3).join(),
    placeMm: new Vector3(...spacingMm).multiply(new Vector3().fromArray(positions, 4 * i)).divideScalar(1024),
    normal: new Vector3()
      .fromArray(normals, 4 * i)
      .divide(new Vector3(...spacingMm))
      .normalize(),
    marks: normals[4 * i + 3] ?? 0,
  }));

function trianglesOf(surface: BlockSurface): Triangle[] {
  const at = cornersOf(surface).map(({ placeMm }) => placeMm);
  const corner = (i: number) => at[surface.indices[i] ?? 0] ?? new Vector3(NaN);
  return Array.from(
    { length: surface.indices.length / 3 },
    (_, i) => new Triangle(corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)),
  );
}

/** By how much light falls otherwise: normals of the whole surface against those between the simple one's corners. */
function mostTurnedDeg(whole: BlockSurface, simple: BlockSurface): number {
  const corners = cornersOf(simple);
  const triangles = trianglesOf(simple);
  let most = 0;
  for (const { placeMm, normal } of cornersOf(whole)) {
    const nearest = triangles
      .map((triangle, i) => ({ i, at: triangle.closestPointToPoint(placeMm, new Vector3()) }))
      .reduce((a, b) => (b.at.distanceTo(placeMm) < a.at.distanceTo(placeMm) ? b : a));
    const share = triangles[nearest.i]?.getBarycoord(nearest.at, new Vector3()) ?? new Vector3(NaN);
    const between = new Vector3();
    share.toArray().forEach((part, corner) => {
      const { normal: of } = corners[simple.indices[3 * nearest.i + corner] ?? 0] ?? { normal: new Vector3(NaN) };
      between.addScaledVector(of, part);
    });
    most = Math.max(most, (between.angleTo(normal) * 180) / Math.PI);
  }
  return most;
}

beforeAll(() => simplifierReady);

describe('A simplified surface', () => {
  it('has a fifth of the triangles and lies where the whole one does', () => {
    const whole = cap();
    const simple = simplifiedSurface(whole, spacingMm);
    expect(simple).toMatchObject({ block: 7, revision: 3, tick: 12 });
    expect(simple.indices.length).toBeLessThan(whole.indices.length / 5);
    const triangles = trianglesOf(simple);
    const offMm = cornersOf(whole).map(({ placeMm }) =>
      Math.min(...triangles.map((one) => one.closestPointToPoint(placeMm, new Vector3()).distanceTo(placeMm))),
    );
    // What is kept to is the mean of the squares over what a triangle stands for.
    expect(Math.max(...offMm)).toBeLessThan(2 * simplifiedToMm);
    expect(Math.hypot(...offMm) / Math.sqrt(offMm.length)).toBeLessThan(simplifiedToMm);
    expect(Math.max(...offMm)).toBeGreaterThan(0);
    expect(mostTurnedDeg(whole, simple)).toBeLessThan(1);
    for (const triangle of triangles) expect(triangle.getNormal(new Vector3()).z).toBeGreaterThan(0.9);
  });

  it('keeps every corner that a neighbour has, too', () => {
    const kept = new Set(cornersOf(simplifiedSurface(cap(), spacingMm)).map(({ steps }) => steps));
    const last = 1024 * edge;
    const shared = cornersOf(cap()).filter(({ steps }) => {
      const [x, y] = steps.split(',').map(Number);
      return x === 0 || x === last || y === 0 || y === last;
    });
    expect(shared).toHaveLength(4 * edge);
    expect(shared.filter(({ steps }) => !kept.has(steps))).toEqual([]);
  });

  it('keeps the line where the kind of bone changes', () => {
    const whole = cap((x) => (x < 13 ? 1 : 2));
    const simple = simplifiedSurface(whole, spacingMm);
    const kept = new Set(cornersOf(simple).map(({ steps, marks }) => `${steps} ${String(marks)}`));
    const along = cornersOf(whole).filter(({ steps }) =>
      ['12', '13'].includes(String(Number(steps.split(',')[0]) / 1024)),
    );
    expect(along).toHaveLength(2 * (edge + 1));
    expect(along.filter(({ steps, marks }) => !kept.has(`${steps} ${String(marks)}`))).toEqual([]);
    expect(simple.indices.length).toBeLessThan(whole.indices.length / 3);
  });

  it('is the whole one where bone is gone, and where there is none', () => {
    const reamed = cap((x, y) => (x === 5 && y === 9 ? goneStep + bone : bone));
    expect(simplifiedSurface(reamed, spacingMm)).toBe(reamed);
    const none = { ...cap(), positions: new Uint16Array(), normals: new Int16Array(), indices: new Uint16Array() };
    expect(simplifiedSurface(none, spacingMm)).toBe(none);
  });

  it('is the same whenever it is made', () => {
    expect(simplifiedSurface(cap(), spacingMm)).toEqual(simplifiedSurface(cap(), spacingMm));
  });
});
