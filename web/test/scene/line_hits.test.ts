import {
  BufferGeometry,
  DoubleSide,
  Float32BufferAttribute,
  FrontSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  Plane,
  Ray,
  Raycaster,
  Vector3,
} from 'three';
import { afterEach, describe, expect, it, vi } from 'vitest';

import type { BonePicture } from '../../src/scene/bone_picture';
import { pickBone } from '../../src/scene/bone_picker';
import type { BlockSurface } from '../../src/wire/messages';
import { blockCount, fullSurface, pictured, placeOf, randomNumbers, randomSurface } from './random_surfaces';

const trees = vi.hoisted(() => ({ made: 0 }));
vi.mock('three-mesh-bvh', async (importOriginal) => {
  const original = await importOriginal<typeof import('three-mesh-bvh')>();
  class CountedTree extends original.MeshBVH {
    constructor(...given: ConstructorParameters<typeof original.MeshBVH>) {
      super(...given);
      ++trees.made;
    }
  }
  return { ...original, MeshBVH: CountedTree };
});

/** The whole grid is 150 by 50 by 127.5 mm. */
const middle = new Vector3(75, 25, 64);

function randomSight(random: () => number): { origin: Vector3; direction: Vector3 } {
  const direction = () => new Vector3(random() - 0.5, random() - 0.5, random() - 0.5).normalize();
  const origin = middle.clone().addScaledVector(direction(), 300);
  const target = middle.clone().add(new Vector3(150, 50, 127.5).multiply(direction()).multiplyScalar(0.5));
  return { origin, direction: target.sub(origin).normalize() };
}

/** All triangles in one mesh of their own, in the grid. */
function allTogether(surfaces: Iterable<BlockSurface>): Mesh {
  const places: number[] = [];
  for (const { block, positions, indices } of surfaces)
    for (const corner of indices) places.push(...placeOf(block, positions, corner).toArray());
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(places, 3));
  return new Mesh(geometry, new MeshBasicMaterial());
}

/** Blocks drawn together, some of them left out again, and blocks with meshes of their own. */
function mixedPicture(random: () => number): { picture: BonePicture; newest: Map<number, BlockSurface> } {
  const picture = pictured();
  const newest = new Map<number, BlockSurface>();
  const put = (surface: BlockSurface) => {
    picture.apply(surface, 0);
    newest.set(surface.block, surface);
  };
  for (let block = 0; block < blockCount; ++block) put(randomSurface(random, block, 0));
  picture.whole();
  while (picture.settleOne(0));
  for (let i = 0; i < 80; ++i) put(randomSurface(random, Math.floor(random() * blockCount), 1 + i));
  return { picture, newest };
}

describe('what a line of sight meets of a streamed bone', () => {
  afterEach(() => vi.restoreAllMocks());

  it.each([1, 2, 3, 4])('is what trying every triangle finds, cut or not (seed %i)', (seed) => {
    const random = randomNumbers(seed);
    const { picture, newest } = mixedPicture(random);
    const group = new Group().add(picture.group);
    const all = allTogether(newest.values());
    let met = 0;
    for (let i = 0; i < 200; ++i) {
      const sight = randomSight(random);
      const normal = new Vector3(random() - 0.5, random() - 0.5, random() - 0.5).normalize();
      const cuts = i % 2 === 0 ? [] : [new Plane().setFromNormalAndCoplanarPoint(normal, middle)];
      (all.material as MeshBasicMaterial).side = cuts.length > 0 ? DoubleSide : FrontSide;
      const expected = new Raycaster(sight.origin, sight.direction)
        .intersectObject(all)
        .find(({ point }) => cuts.every((cut) => cut.distanceToPoint(point) >= 0));
      const found = pickBone(group, sight, cuts);
      expect(found === null).toBe(expected === undefined);
      if (found === null || expected === undefined) continue;
      ++met;
      expect(expected.point.distanceTo(new Vector3(...found.place))).toBeLessThan(1e-3);
    }
    expect(met).toBeGreaterThan(50);
  });

  it('is found without a tree, in the few blocks that lie on the line', () => {
    const random = randomNumbers(9);
    const picture = pictured();
    let triangles = 0;
    for (let block = 0; block < blockCount; ++block) {
      const surface = fullSurface(random, block, 0);
      triangles += surface.indices.length / 3;
      picture.apply(surface, 0);
    }
    picture.whole();
    while (picture.settleOne(0));
    const group = new Group().add(picture.group);
    trees.made = 0;
    const tried = vi.spyOn(Ray.prototype, 'intersectTriangle');
    const sights = 40;
    for (let i = 0; i < sights; ++i) pickBone(group, randomSight(random), []);
    expect(trees.made).toBe(0);
    expect(tried.mock.calls.length).toBeGreaterThan(0);
    // A line that passes 10 by 7 by 6 blocks meets 21 of them at most, and touches some more where they overlap.
    expect(tried.mock.calls.length).toBeLessThan((sights * triangles) / 20);
  });
});
