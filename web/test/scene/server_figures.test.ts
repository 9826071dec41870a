// What the page and the server must say alike is held together here.
import { readFileSync } from 'node:fs';

import { Color } from 'three';
import { describe, expect, it } from 'vitest';

import { cutBoneColours, cutFrom } from '../../src/scene/cut_bone';
import { beyondReach } from '../../src/scene/surroundings_view';
import { lipAngleDeg, lipCount } from '../../src/scene/tool_shape';
import { isTwoPlates } from '../../src/wire/messages';
import type { Surface } from '../../src/wire/ply';

const source = (path: string) => readFileSync(new URL(`../../../server/${path}`, import.meta.url), 'utf8');

function figures(path: string, name: RegExp): number[] {
  const found = name.exec(source(path))?.slice(1) ?? [];
  if (found.length === 0) throw new Error(`${path} has no ${name.source}`);
  return found.map(Number);
}

/** One triangle with all corners in that place. */
function at(x: number, y: number, z: number): Surface {
  const positions = new Float32Array([x, y, z, x, y, z, x, y, z]);
  return { positions, normals: positions, indices: new Uint32Array([0, 1, 2]), low: [0, 0, 0], high: [0, 0, 0] };
}
const isLeft = (surface: Surface, gridVoxels = 200) =>
  beyondReach(surface, {
    axisEntryMm: [1, 2, 3],
    axisDirection: [0, 0, 1],
    gridDims: [gridVoxels, gridVoxels, gridVoxels],
    voxelSpacingMm: [0.5, 0.5, 0.5],
    worldFromGrid: { translationMm: [-50, -50, -50], rotationXyzw: [0, 0, 0, 1] },
  }).length > 0;

describe('beyondReach', () => {
  it('knows a grid that lies turned', () => {
    // Its x is the world's y: 5 mm wide and 100 mm long, beside the axis.
    const turned = {
      axisEntryMm: [1, 2, 3],
      axisDirection: [0, 0, 1],
      gridDims: [200, 10, 200],
      voxelSpacingMm: [0.5, 0.5, 0.5],
      worldFromGrid: { translationMm: [0, 0, -50], rotationXyzw: [0, 0, Math.SQRT1_2, Math.SQRT1_2] },
    } satisfies Parameters<typeof beyondReach>[1];
    expect(beyondReach(at(-2, 20, 0), turned).length).toBe(0);
    expect(beyondReach(at(2, 20, 0), turned).length).toBe(3);
  });
});

describe('page and server', () => {
  it('paint cut bone alike', () => {
    const colour = /cut_bone_colour\{([\d.]+)f, ([\d.]+)f, ([\d.]+)f\}/;
    const linear = new Color(cutBoneColours.cancellous).toArray();
    expect(figures('surface/removed_share.hpp', /cut_share = ([\d.]+)f/)).toEqual([cutFrom]);
    figures('render/snapshot.hpp', colour).forEach((value, i) => expect(value).toBeCloseTo(linear[i] ?? 0, 3));
  });

  it('know the plates of a study of feel', () => {
    const prefix = /id_prefix = "([^"]+)"/.exec(source('case/two_plates.cpp'))?.[1] ?? '';
    expect(isTwoPlates({ caseId: `${prefix}0a1b2c3d` })).toBe(true);
    expect(isTwoPlates({ caseId: 'demo' })).toBe(false);
  });

  it('have the same lips', () => {
    const path = 'force/coefficients.hpp';
    expect(figures(path, /lip_count = (\d+)/)).toEqual([lipCount]);
    expect(figures(path, /lip_angle_rad = radians_from_degrees\(([\d.]+)\)/)).toEqual([lipAngleDeg]);
  });

  it('leave out the same surroundings', () => {
    const path = 'ct/build/surroundings.cpp';
    const [reach = 0, depth = 0] = figures(path, /reamers_reach_mm = ([\d.]+), reamers_depth_mm = ([\d.]+)/);
    expect(isLeft(at(1 + reach - 0.01, 2, 3))).toBe(false);
    expect(isLeft(at(1 + reach + 0.01, 2, 3))).toBe(true);
    // Beyond the grid's box nothing is ever cut.
    expect(isLeft(at(1 + reach - 0.01, 2, 3), 10)).toBe(true);
    expect(isLeft(at(1, 2, 3 + depth - 0.01))).toBe(false);
    expect(isLeft(at(1, 2, 3 + depth + 0.01))).toBe(true);
    expect(isLeft(at(1, 2, -49))).toBe(false);
  });
});
