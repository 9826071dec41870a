import type { Triple } from '../../wire/rest_types';
import { type PlacedLandmarks, pointOf } from './landmark_names';

/** Farther from the rim's middle than this, across the face, a centre is more likely misplaced than anatomy. */
export const farFromMiddleMm = 4;

export interface RimCheck {
  /** Across the face; how deep the face is hollowed does not count. */
  offMm: number;
  /** The rim's middle, as deep as the centre that was placed. */
  middle: Triple;
}

/** How far the glenoid's centre is from the middle of its rim; null while a point of both is missing. */
export function checkCentre(landmarks: PlacedLandmarks): RimCheck | null {
  const centre = pointOf(landmarks, 'glenoid_centre_mm');
  const top = pointOf(landmarks, 'superior_rim_mm');
  const bottom = pointOf(landmarks, 'inferior_rim_mm');
  const front = pointOf(landmarks, 'anterior_rim_mm');
  const back = pointOf(landmarks, 'posterior_rim_mm');
  if (centre === null || top === null || bottom === null || front === null || back === null) return null;
  const mean = times(plus(plus(top, bottom), plus(front, back)), 0.25);
  const across = cross(minus(top, bottom), minus(front, back));
  const length = Math.hypot(...across);
  if (length === 0) return null;
  const normal = times(across, 1 / length);
  const middle = plus(mean, times(normal, dot(minus(centre, mean), normal)));
  return { offMm: Math.hypot(...minus(centre, middle)), middle };
}

const plus = (a: Triple, b: Triple): Triple => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const times = (a: Triple, by: number): Triple => [a[0] * by, a[1] * by, a[2] * by];
const minus = (a: Triple, b: Triple): Triple => plus(a, times(b, -1));
const dot = (a: Triple, b: Triple): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Triple, b: Triple): Triple => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
