import { Mesh, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import type { BonePicture } from '../../src/scene/bone_picture';
import type { BlockSurface } from '../../src/wire/messages';
import { blockCount, fullSurface, pictured, placeOf, randomNumbers, randomSurface } from './random_surfaces';

const settledMs = 10_000;

/** Of each corner its place in the grid, mm, its direction and its marks. */
type Corner = readonly [place: Vector3, direction: string, marks: number];
const triangleOf = (corners: readonly Corner[]) =>
  corners
    .map(([place, direction, marks]) =>
      [...place.toArray().map((x) => x.toFixed(4)), direction, marks.toFixed(0)].join(','),
    )
    .join(' ');

function drawn(picture: BonePicture): string[] {
  const found: string[] = [];
  picture.group.traverse((part) => {
    if (!(part instanceof Mesh)) return;
    const mesh = part as Mesh;
    const { position, normal, boneMarks } = mesh.geometry.attributes;
    const { index } = mesh.geometry;
    if (!position || !normal || !boneMarks || index === null) throw new Error('a mesh without corners');
    const corner = (at: number): Corner => [
      new Vector3().fromBufferAttribute(position, at).applyMatrix4(mesh.matrix),
      new Vector3()
        .fromBufferAttribute(normal, at)
        .toArray()
        .map((x) => x.toFixed(6))
        .join(','),
      boneMarks.getX(at),
    ];
    for (let i = 0; i < index.count; i += 3) {
      const corners = [index.getX(i), index.getX(i + 1), index.getX(i + 2)];
      if (corners[0] !== corners[1]) found.push(triangleOf(corners.map(corner)));
    }
  });
  return found.sort();
}

function trianglesOf(surfaces: Iterable<BlockSurface>): string[] {
  const found: string[] = [];
  for (const { block, positions, normals, indices } of surfaces) {
    const corner = (at: number): Corner => [
      placeOf(block, positions, at),
      Array.from(normals.subarray(4 * at, 4 * at + 3), (x) => Math.max(x / 32767, -1).toFixed(6)).join(','),
      normals[4 * at + 3] ?? NaN,
    ];
    for (let i = 0; i < indices.length; i += 3) found.push(triangleOf([...indices.subarray(i, i + 3)].map(corner)));
  }
  return found.sort();
}

const meshes = (picture: BonePicture) => picture.group.children.length;
const drawnIndices = (picture: BonePicture) =>
  picture.group.children.reduce((sum, part) => sum + ((part as Mesh).geometry.index?.count ?? 0), 0);
const regionOf = (block: number) =>
  [block % 10, Math.floor(block / 10) % 7, Math.floor(block / 70)].map((at) => Math.floor(at / 4)).join(' ');

const emptySurface = (block: number, revision: number) => randomSurface(() => 0, block, revision);

/** Blocks 0 to 2, of one region, drawn together. */
function settledRow(random: () => number): BonePicture {
  const picture = pictured();
  for (let block = 0; block < 3; ++block) picture.apply(fullSurface(random, block, 0), 0);
  picture.whole();
  while (picture.settleOne(0));
  expect([meshes(picture), picture.restless]).toEqual([1, false]);
  return picture;
}

describe('BonePicture', () => {
  it.each([1, 2, 3, 4, 5, 6, 7, 8])(
    'draws every block as it was told last, whatever is drawn together (seed %i)',
    (seed) => {
      const random = randomNumbers(seed);
      const picture = pictured();
      const newest = new Map<number, BlockSurface>();
      for (let step = 0, nowMs = 0; step < 400; ++step, nowMs += random() * 400) {
        const block = Math.floor(random() ** 2 * blockCount);
        const surface = randomSurface(random, block, step);
        picture.apply(surface, nowMs);
        newest.set(block, surface);
        if (random() < 0.3) picture.settleOne(nowMs);
        if (step % 20 === 0) expect(drawn(picture)).toEqual(trianglesOf(newest.values()));
      }
      while (picture.settleOne(1e9));
      expect(drawn(picture)).toEqual(trianglesOf(newest.values()));
      expect(picture.restless).toBe(false);
      // Nothing is kept of what is not seen any more.
      const seen = [...newest.values()].filter(({ indices }) => indices.length > 0);
      expect(meshes(picture)).toBe(new Set(seen.map(({ block }) => regionOf(block))).size);
      expect(drawnIndices(picture)).toBe(seen.reduce((sum, { indices }) => sum + indices.length, 0));
    },
  );

  it('draws a picture that is whole by regions, and again block by block what changes', () => {
    const random = randomNumbers(11);
    const picture = pictured();
    for (let block = 0; block < blockCount; ++block) {
      picture.apply(fullSurface(random, block, 0), 0);
    }
    expect(meshes(picture)).toBe(blockCount);
    picture.whole();
    while (picture.settleOne(0));
    expect(meshes(picture)).toBe(3 * 2 * 2);
    expect(picture.restless).toBe(false);

    picture.apply(fullSurface(random, 5, 1), 100);
    expect(picture.settleOne(200)).toBe(false);
    expect(meshes(picture)).toBe(3 * 2 * 2 + 1);
    expect(picture.settleOne(settledMs)).toBe(true);
    expect(meshes(picture)).toBe(3 * 2 * 2);
  });

  it('lets go of a region that is reamed away', () => {
    const picture = settledRow(randomNumbers(21));
    let disposed = 0;
    (picture.group.children[0] as Mesh).geometry.addEventListener('dispose', () => ++disposed);
    for (let block = 0; block < 3; ++block) picture.apply(emptySurface(block, 1), 100);
    expect(picture.restless).toBe(true);
    expect(picture.settleOne(settledMs)).toBe(true);
    expect([meshes(picture), disposed, picture.restless]).toEqual([0, 1, false]);
    expect(picture.settleOne(settledMs)).toBe(false);
  });

  it('lets go of blocks that are reamed away beside others that stay', () => {
    const picture = settledRow(randomNumbers(22));
    const before = drawnIndices(picture);
    const count = trianglesOf([fullSurface(randomNumbers(22), 0, 0)]).length * 3;
    picture.apply(emptySurface(0, 1), 100);
    expect(picture.settleOne(settledMs)).toBe(true);
    expect(drawnIndices(picture)).toBe(before - count);
    expect([meshes(picture), picture.restless]).toEqual([1, false]);
  });

  it('copies nothing for a block that came and went', () => {
    const random = randomNumbers(23);
    const picture = settledRow(random);
    const [together] = picture.group.children;
    picture.apply(fullSurface(random, 3, 1), 100);
    picture.apply(emptySurface(3, 2), 200);
    expect(picture.settleOne(settledMs)).toBe(false);
    expect(picture.group.children).toEqual([together]);
    expect(picture.restless).toBe(false);
  });

  it('draws few blocks that rest together only once their neighbours rest, too', () => {
    const random = randomNumbers(24);
    const picture = settledRow(random);
    const [together] = picture.group.children;
    picture.apply(fullSurface(random, 0, 1), 0);
    let nowMs = 0;
    for (let revision = 1; nowMs < settledMs; nowMs += 500) {
      picture.apply(fullSurface(random, 1, ++revision), nowMs);
      expect(picture.settleOne(nowMs)).toBe(false);
      expect(picture.group.children).toContain(together);
    }
    expect(meshes(picture)).toBe(3);
    expect(picture.settleOne(nowMs + settledMs)).toBe(true);
    expect(meshes(picture)).toBe(1);
  });

  it('does not wait for a neighbour that keeps changing while many blocks rest', () => {
    const random = randomNumbers(25);
    const picture = pictured();
    const region = [0, 1, 2, 3].flatMap((x) =>
      [0, 1, 2, 3].flatMap((y) => [0, 1, 2, 3].map((z) => x + 10 * y + 70 * z)),
    );
    for (const block of region) picture.apply(fullSurface(random, block, 0), 0);
    picture.apply(fullSurface(random, 0, 1), settledMs - 1);
    expect(meshes(picture)).toBe(64);
    expect(picture.settleOne(settledMs)).toBe(true);
    expect(meshes(picture)).toBe(2);
    expect(picture.restless).toBe(true);
  });

  it('keeps a block that is newer than what is told', () => {
    const random = randomNumbers(3);
    const picture = pictured();
    const newer = randomSurface(random, 9, 5);
    picture.apply(newer, 0);
    while (picture.settleOne(settledMs));
    picture.apply(randomSurface(random, 9, 4), settledMs);
    expect(drawn(picture)).toEqual(trianglesOf([newer]));
  });

  it('leaves nothing behind', () => {
    const random = randomNumbers(4);
    const picture = pictured();
    for (let block = 0; block < 50; ++block) picture.apply(randomSurface(random, block, 0), 0);
    picture.whole();
    picture.settleOne(0);
    picture.dispose();
    expect(meshes(picture)).toBe(0);
    expect(picture.blockCount).toBe(0);
  });
});
