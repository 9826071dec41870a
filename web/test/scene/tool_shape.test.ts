import type { BufferGeometry } from 'three';
import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { bladesOf, bodyOf, hubMm, lipCount, sweptOf } from '../../src/scene/tool_shape';
import { faceHeightMm, profileOf, type ToolProfile } from '../../src/scene/tool_profile';
import { libraryOutlines, revolved } from './library_tools';

const profiles = Object.entries(libraryOutlines).map(([name, outline]) => {
  const profile = profileOf(revolved(outline));
  if (profile === null) throw new Error(`${name} is no reamer`);
  return [name, profile] as const;
});

function corners(geometry: BufferGeometry): Vector3[] {
  const at = geometry.getAttribute('position');
  return Array.from({ length: at.count }, (_, i) => new Vector3().fromBufferAttribute(at, i));
}

/** The corners, and what lies between them. */
function surface(geometry: BufferGeometry): Vector3[] {
  const all = corners(geometry);
  const between: Vector3[] = [];
  for (let i = 0; i < all.length; i += 3) {
    const three = all.slice(i, i + 3);
    for (const [a, b, c] of [
      [1, 1, 1],
      [1, 1, 0],
      [0, 1, 1],
      [1, 0, 1],
    ] as const) {
      const at = new Vector3();
      [a, b, c].forEach((weight, k) => at.addScaledVector(three[k] ?? at, weight / (a + b + c)));
      between.push(at);
    }
  }
  return [...all, ...between];
}

const offOf = ({ x, y }: Vector3) => Math.hypot(x, y);

/** How far a place stands out of the envelope, of the head: face, nipple and wall. */
function outsideMm(profile: ToolProfile, at: Vector3): number {
  const off = offOf(at);
  const foot = profile.nipple.at(-1)?.offMm ?? -1;
  const top = off <= foot ? Math.max(...profile.nipple.map(({ zMm }) => zMm)) : faceHeightMm(profile, off);
  return Math.max(off - profile.rimMm, at.z - top);
}

/** Of float32. */
const exactMm = 1e-5;
/** What lies between two corners of a ring is nearer to the axis than they are; less than a face falls there. */
const chordMm = 0.02;

describe.each(profiles)('the instrument of %s', (_, profile) => {
  const blades = bladesOf(profile);

  it('stands nowhere outside of what cuts', () => {
    for (const shape of [blades, bodyOf(profile), sweptOf(profile)]) {
      const most = (places: Vector3[]) => Math.max(...places.map((at) => outsideMm(profile, at)));
      expect(most(corners(shape))).toBeLessThan(exactMm);
      expect(most(surface(shape))).toBeLessThan(chordMm);
    }
  });

  it('has lips that lie on what cuts, from hub to rim', () => {
    const onFace = corners(blades).filter((at) => Math.abs(at.z - faceHeightMm(profile, offOf(at))) < exactMm);
    const offs = onFace.map(offOf).sort((a, b) => a - b);
    expect(offs[0]).toBeLessThan(hubMm(profile));
    expect(offs.at(-1)).toBeGreaterThan(profile.rimMm - 0.05);
    // Between all lips together no ring of the face is left out that is wider than a step of theirs.
    expect(Math.max(...offs.map((off, i) => off - (offs[i - 1] ?? off)))).toBeLessThan(1.3);
    // As many at the rim as there are lips.
    const atRim = onFace.filter((at) => offOf(at) > profile.rimMm - 0.05);
    expect(new Set(atRim.map((at) => Math.round(Math.atan2(at.y, at.x) * 100))).size).toBe(lipCount);
  });

  it('has teeth', () => {
    const lips = corners(blades).filter((at) => offOf(at) > hubMm(profile));
    const backs = lips.map((at) => faceHeightMm(profile, offOf(at)) - at.z);
    expect(backs.filter((mm) => mm > 0.2).length).toBeGreaterThan(lipCount);
  });

  it('leaves the bone to be seen between its blades', () => {
    const middleMm = (hubMm(profile) + profile.rimMm) / 2;
    const near = surface(blades).filter((at) => Math.abs(offOf(at) - middleMm) < 1);
    const turns = near.map((at) => Math.atan2(at.y, at.x)).sort((a, b) => a - b);
    const open = turns.map((turn, i) => turn - (turns[i - 1] ?? (turns.at(-1) ?? 0) - 2 * Math.PI));
    expect(open.filter((gap) => gap > 0.4)).toHaveLength(lipCount);
    // Nor does the body stand in the openings.
    expect(surface(bodyOf(profile)).filter((at) => Math.abs(offOf(at) - middleMm) < 0.5)).toEqual([]);
  });

  it('has a rim where the face ends, and a shaft behind the head', () => {
    const body = corners(bodyOf(profile));
    expect(Math.max(...body.map(offOf))).toBeGreaterThan(profile.rimMm - 0.2);
    const behind = body.filter((at) => at.z < profile.backZMm - 1);
    expect(Math.max(...behind.map(offOf))).toBeLessThan(Math.max(hubMm(profile), 4) + exactMm);
    expect(Math.min(...behind.map((at) => at.z))).toBeLessThan(profile.backZMm - 40);
  });

  it('has normals that point out of it', () => {
    for (const shape of [blades, bodyOf(profile), sweptOf(profile)]) expect(volumeMm3(shape)).toBeGreaterThan(50);
  });
});

it('shows a nipple as high as what guides, and a bore where there is none', () => {
  const highest = (profile: ToolProfile) => Math.max(...corners(bodyOf(profile)).map((at) => at.z));
  const [nippled, bored] = ['convex-30', 'cannulated-40'].map((name) => new Map(profiles).get(name));
  if (nippled === undefined || bored === undefined) throw new Error('not in the library');
  expect(highest(nippled)).toBeCloseTo(8, 1);
  expect(highest(bored)).toBeLessThan(0);
  const onAxis = corners(bodyOf(bored)).filter((at) => offOf(at) < 0.01);
  expect(Math.max(...onAxis.map((at) => at.z))).toBeLessThan(faceHeightMm(bored, 0) - 2);
});

/** By the divergence theorem; below zero where a closed surface is inside out. */
function volumeMm3(geometry: BufferGeometry): number {
  const all = corners(geometry);
  let sum = 0;
  for (let i = 0; i < all.length; i += 3) {
    const [a, b, c] = all.slice(i, i + 3);
    if (a !== undefined && b !== undefined && c !== undefined) sum += a.dot(b.clone().cross(c)) / 6;
  }
  return sum;
}
