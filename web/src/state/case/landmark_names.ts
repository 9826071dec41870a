import type { HumeralHead, Landmarks, PointName, Triple } from '../../wire/case_types';

export type LandmarkName = PointName | 'humeral_head';

/** In the order in which they are placed; the number key of each is its place here, from 1. */
export const landmarkNames: readonly LandmarkName[] = [
  'glenoid_centre_mm',
  'superior_rim_mm',
  'inferior_rim_mm',
  'anterior_rim_mm',
  'posterior_rim_mm',
  'trigonum_mm',
  'inferior_angle_mm',
  'humeral_head',
  'biconcavity_mm',
];
/** Without these no version is measured. */
export const neededNames: readonly LandmarkName[] = landmarkNames.slice(0, 7);
/** The ridge of a biconcave glenoid; most glenoids have none. */
export const isOptional = (name: LandmarkName): boolean => name === 'biconcavity_mm';

export const typicalHeadRadiusMm = 24;
export const headRadiusLimitsMm = { low: 12, high: 40 };

export function pointOf(landmarks: Landmarks, name: LandmarkName): Triple | null {
  return (name === 'humeral_head' ? landmarks.humeral_head?.centre_mm : landmarks[name]) ?? null;
}

/** The landmarks with one placed, moved, or (null) taken away. */
export function withPoint(landmarks: Landmarks, name: LandmarkName, point: Triple | null): Landmarks {
  const changed: Landmarks = { ...landmarks };
  if (name === 'humeral_head') {
    const radius_mm = landmarks.humeral_head?.radius_mm ?? typicalHeadRadiusMm;
    if (point === null) delete changed.humeral_head;
    else changed.humeral_head = { centre_mm: point, radius_mm } satisfies HumeralHead;
  } else if (point === null) delete changed[name];
  else changed[name] = point;
  return changed;
}

/** What is to be placed after one was: the next that is missing, the optional one left aside; null: nothing. */
export function nextMissing(landmarks: Landmarks, after: LandmarkName): LandmarkName | null {
  const from = landmarkNames.indexOf(after) + 1;
  const order = [...landmarkNames.slice(from), ...landmarkNames.slice(0, from)];
  return order.find((name) => !isOptional(name) && pointOf(landmarks, name) === null) ?? null;
}

export function sameLandmarks(a: Landmarks | null, b: Landmarks | null): boolean {
  const [one, other] = [a ?? {}, b ?? {}];
  const samePoint = (p: Triple | null, q: Triple | null) =>
    p === q || (p !== null && q !== null && p.every((value, i) => Math.abs(value - (q[i] ?? NaN)) < 1e-6));
  return (
    landmarkNames.every((name) => samePoint(pointOf(one, name), pointOf(other, name))) &&
    (one.walch ?? null) === (other.walch ?? null) &&
    Math.abs((one.humeral_head?.radius_mm ?? 0) - (other.humeral_head?.radius_mm ?? 0)) < 1e-6
  );
}
