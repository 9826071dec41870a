import type { Landmarks, Triple, WalchClass } from '../../wire/rest_types';

export const biconcavityNames = ['biconcavity_0', 'biconcavity_1', 'biconcavity_2'] as const;
type BiconcavityName = (typeof biconcavityNames)[number];
/** Landmarks that are points, by their keys. */
type PointName = Exclude<keyof Landmarks, 'humeral_head' | 'biconcavity_mm' | 'walch'>;
export type LandmarkName = PointName | 'humeral_head' | BiconcavityName;

/** What is placed on the page; the points of a biconcave face one by one, unlike in landmarks.json. */
export type PlacedLandmarks = Partial<Record<PointName | BiconcavityName, Triple>> & {
  humeral_head?: NonNullable<Landmarks['humeral_head']>;
  walch?: WalchClass;
};

/** In the order in which they are placed; the number key of each is its place here, from 1 to 9. */
export const landmarkNames: readonly LandmarkName[] = [
  'glenoid_centre_mm',
  'superior_rim_mm',
  'inferior_rim_mm',
  'anterior_rim_mm',
  'posterior_rim_mm',
  'trigonum_mm',
  'inferior_angle_mm',
  'humeral_head',
  ...biconcavityNames,
];
/** Without these no version is measured. */
export const neededNames: readonly LandmarkName[] = landmarkNames.slice(0, 7);
/** Points of a biconcave face; most glenoids have none. */
export const isOptional = (name: LandmarkName): boolean => biconcavityNames.some((other) => other === name);

export const typicalHeadRadiusMm = 24;
export const headRadiusLimitsMm = { low: 12, high: 40 };

export function placedFrom(landmarks: Landmarks | null): PlacedLandmarks {
  const { biconcavity_mm = [], ...others } = landmarks ?? {};
  const placed: PlacedLandmarks = { ...others };
  biconcavityNames.forEach((name, i) => {
    const point = biconcavity_mm[i];
    if (point !== undefined) placed[name] = point;
  });
  return placed;
}

/** landmarks.json of what is placed; a biconcave face only once all its three points are. */
export function landmarksOf(placed: PlacedLandmarks): Landmarks {
  const { biconcavity_0: first, biconcavity_1: ridge, biconcavity_2: last, ...others } = placed;
  if (first === undefined || ridge === undefined || last === undefined) return others;
  return { ...others, biconcavity_mm: [first, ridge, last] };
}

export function pointOf(landmarks: PlacedLandmarks, name: LandmarkName): Triple | null {
  return (name === 'humeral_head' ? landmarks.humeral_head?.centre_mm : landmarks[name]) ?? null;
}

/** The landmarks with one placed, moved, or (null) taken away. */
export function withPoint(landmarks: PlacedLandmarks, name: LandmarkName, point: Triple | null): PlacedLandmarks {
  const changed: PlacedLandmarks = { ...landmarks };
  if (name === 'humeral_head') {
    const radius_mm = landmarks.humeral_head?.radius_mm ?? typicalHeadRadiusMm;
    if (point === null) delete changed.humeral_head;
    else changed.humeral_head = { centre_mm: point, radius_mm };
  } else if (point === null) delete changed[name];
  else changed[name] = point;
  return changed;
}

/** What is to be placed after one was: the next that is missing, those of a biconcave face only once begun; null: nothing. */
export function nextMissing(landmarks: PlacedLandmarks, after: LandmarkName | null): LandmarkName | null {
  const from = after === null ? 0 : landmarkNames.indexOf(after) + 1;
  const order = [...landmarkNames.slice(from), ...landmarkNames.slice(0, from)];
  const begun = after !== null && isOptional(after);
  return order.find((name) => (begun || !isOptional(name)) && pointOf(landmarks, name) === null) ?? null;
}

export function sameLandmarks(one: Landmarks | null, other: Landmarks | null): boolean {
  const [a, b] = [placedFrom(one), placedFrom(other)];
  const samePoint = (p: Triple | null, q: Triple | null) =>
    p === q || (p !== null && q !== null && p.every((value, i) => Math.abs(value - (q[i] ?? NaN)) < 1e-6));
  return (
    landmarkNames.every((name) => samePoint(pointOf(a, name), pointOf(b, name))) &&
    (a.walch ?? null) === (b.walch ?? null) &&
    Math.abs((a.humeral_head?.radius_mm ?? 0) - (b.humeral_head?.radius_mm ?? 0)) < 1e-6
  );
}
