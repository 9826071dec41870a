import type { Triple } from '../wire/rest_types';
import type { VoxelAxis } from '../wire/case_api';
import { dot, numberOf, voxelAxes, type VolumeFrame } from './volume_frame';

export type PlaneName = 'axial' | 'coronal' | 'sagittal';
export const planeNames: readonly PlaneName[] = ['axial', 'coronal', 'sagittal'];

/**
 * LPS directions of a picture's normal, right and down as radiologists look at it: the patient's right is on the left
 * of axial and coronal pictures, front is on top of axial ones and left in sagittal ones.
 */
const looks: Record<PlaneName, { across: Triple; right: Triple; down: Triple }> = {
  axial: { across: [0, 0, 1], right: [1, 0, 0], down: [0, 1, 0] },
  coronal: { across: [0, 1, 0], right: [1, 0, 0], down: [0, 0, -1] },
  sagittal: { across: [1, 0, 0], right: [0, 1, 0], down: [0, 0, -1] },
};

/** How the slices across one voxel axis are laid on the screen. */
export interface SlicePlane {
  name: PlaneName;
  /** The voxel axis that goes through the slices. */
  axis: VoxelAxis;
  /** Voxel axes along the screen, and whether they run to the right and down (1) or against it (-1). */
  right: { axis: VoxelAxis; sign: 1 | -1 };
  down: { axis: VoxelAxis; sign: 1 | -1 };
  /** At the picture's edges; two letters where the picture lies oblique. */
  letters: { left: string; right: string; top: string; bottom: string };
}

/** The three pictures of a CT: each voxel axis is given to the plane it crosses most squarely. */
export function slicePlanes(frame: VolumeFrame): Record<PlaneName, SlicePlane> {
  const orders: VoxelAxis[][] = [
    ['u', 'v', 'w'],
    ['u', 'w', 'v'],
    ['v', 'u', 'w'],
    ['v', 'w', 'u'],
    ['w', 'u', 'v'],
    ['w', 'v', 'u'],
  ];
  const fit = (order: VoxelAxis[]) =>
    planeNames.reduce((sum, name, i) => sum + Math.abs(along(frame, order[i] ?? 'u', looks[name].across)), 0);
  const best = orders.reduce((a, b) => (fit(b) > fit(a) + 1e-9 ? b : a));
  const plane = (name: PlaneName) => layOut(frame, name, best[planeNames.indexOf(name)] ?? 'w');
  return { axial: plane('axial'), coronal: plane('coronal'), sagittal: plane('sagittal') };
}

function layOut(frame: VolumeFrame, name: PlaneName, axis: VoxelAxis): SlicePlane {
  const { right: wantedRight, down: wantedDown } = looks[name];
  const [a, b] = voxelAxes.filter((other) => other !== axis) as [VoxelAxis, VoxelAxis];
  const straight = Math.abs(along(frame, a, wantedRight)) + Math.abs(along(frame, b, wantedDown));
  const turned = Math.abs(along(frame, b, wantedRight)) + Math.abs(along(frame, a, wantedDown));
  const [rightAxis, downAxis] = straight >= turned ? [a, b] : [b, a];
  const right = { axis: rightAxis, sign: signOf(along(frame, rightAxis, wantedRight)) };
  const down = { axis: downAxis, sign: signOf(along(frame, downAxis, wantedDown)) };
  const towards = ({ axis: of, sign }: SlicePlane['right'], way: 1 | -1) => {
    const [x, y, z] = frame.directions[numberOf(of)];
    return directionLetters([x * sign * way, y * sign * way, z * sign * way]);
  };
  const letters = {
    left: towards(right, -1),
    right: towards(right, 1),
    top: towards(down, -1),
    bottom: towards(down, 1),
  };
  return { name, axis, right, down, letters };
}

function along(frame: VolumeFrame, axis: VoxelAxis, direction: Triple): number {
  return dot(frame.directions[numberOf(axis)], direction);
}

const signOf = (value: number): 1 | -1 => (value < 0 ? -1 : 1);

/** A direction that leans by less than this towards a second one is named by the first alone; sine of 22.5 degrees. */
const secondLetterFrom = 0.383;

/** Letters of a direction in LPS: left, right, anterior, posterior, superior, inferior; the strongest first. */
export function directionLetters(direction: Triple): string {
  const pairs: [string, string][] = [
    ['L', 'R'],
    ['P', 'A'],
    ['S', 'I'],
  ];
  return pairs
    .map(([plus, minus], i) => ({
      letter: (direction[i] ?? 0) >= 0 ? plus : minus,
      share: Math.abs(direction[i] ?? 0),
    }))
    .filter(({ share }) => share >= secondLetterFrom)
    .sort((x, y) => y.share - x.share)
    .map(({ letter }) => letter)
    .join('');
}
