import { type BufferGeometry, Color } from 'three';

import { RingSurface } from './ring_surface';

/** Superior, anterior and lateral of the planned entry, mm. */
export type FieldPoint = readonly [superior: number, anterior: number, lateral: number];

/** How far the wound is held open at a height over the entry, towards each side, mm. */
interface Level {
  lateralMm: number;
  superiorMm: number;
  inferiorMm: number;
  anteriorMm: number;
  posteriorMm: number;
}

/**
 * A deltopectoral wound held open by retractors: over the glenoid it lets a reamer of 40 mm in along the planned axis, and
 * is wider towards the skin to where the surgeon stands. Posterior there is room for the humerus, which is held back. A
 * reamer that leans or stands aside lies in it: soft parts give way.
 */
export const skinMm = 47;
const levels: readonly Level[] = [
  { lateralMm: -15, superiorMm: 8, inferiorMm: 8, anteriorMm: 5, posteriorMm: 5 },
  { lateralMm: -14, superiorMm: 20, inferiorMm: 20, anteriorMm: 15, posteriorMm: 15 },
  { lateralMm: -9, superiorMm: 23, inferiorMm: 25, anteriorMm: 21, posteriorMm: 21 },
  { lateralMm: 2, superiorMm: 26, inferiorMm: 28, anteriorMm: 26, posteriorMm: 27 },
  { lateralMm: 14, superiorMm: 24.5, inferiorMm: 29, anteriorMm: 31, posteriorMm: 42 },
  { lateralMm: 28, superiorMm: 26.5, inferiorMm: 31, anteriorMm: 41, posteriorMm: 50 },
  { lateralMm: 38, superiorMm: 32, inferiorMm: 33, anteriorMm: 47, posteriorMm: 52 },
  { lateralMm: 45, superiorMm: 41, inferiorMm: 35, anteriorMm: 51, posteriorMm: 53 },
  { lateralMm: skinMm, superiorMm: 45, inferiorMm: 39, anteriorMm: 56, posteriorMm: 56 },
];
/** Skin under a film, before the drape begins. */
const skinWideMm = 13;
const drapeWideMm = 480;
/** The shoulder falls away as a ball of this radius, and its drape beyond as a tent of this slope. */
const shoulderRadiusMm = 320;
const tentSlope = 0.25;
/** 2 is an ellipse, more goes towards its box. */
const roundness = 2.1;

const around = 120;
const rowsPerLevel = 5;
const skinRows = 4;
const drapeRows = 26;

const deepBlood = new Color(0x4a0f0f);
const capsule = new Color(0xb98a7a);
const muscle = new Color(0x85332d);
const paleMuscle = new Color(0xa95d51);
const fat = new Color(0xd8bd84);
const skin = new Color(0xd0a081);
const cloth = new Color(0x4a7f87);

/** The wound's edge at an angle from superior towards anterior. */
function edge(level: Level, angle: number): FieldPoint {
  const [along, across] = [Math.cos(angle), Math.sin(angle)];
  const share = (value: number) => Math.sign(value) * Math.abs(value) ** (2 / roundness);
  return [
    share(along) * (along > 0 ? level.superiorMm : level.inferiorMm),
    share(across) * (across > 0 ? level.anteriorMm : level.posteriorMm),
    level.lateralMm,
  ];
}

/** The wound's edge between two levels. */
function edgeBetween(low: Level, high: Level, share: number, angle: number): FieldPoint {
  const [from, to] = [edge(low, angle), edge(high, angle)];
  const at = (axis: 0 | 1 | 2) => from[axis] + share * (to[axis] - from[axis]);
  return [at(0), at(1), at(2)];
}

/** Smooth, without a repetition that is seen; -1 to 1. */
function unevenness(angle: number, along: number): number {
  return (
    0.5 * Math.sin(3 * angle + 0.21 * along) +
    0.3 * Math.sin(7 * angle - 0.43 * along + 1.3) +
    0.2 * Math.sin(17 * angle + 0.9 * along + 0.4)
  );
}

const mixed = (a: Color, b: Color, share: number): Color => a.clone().lerp(b, Math.min(Math.max(share, 0), 1));

/** What the wall is made of at a height: capsule, then muscle, and fat under the skin; `fibre` -1 to 1. */
function wallColour(lateralMm: number, fibre: number): Color {
  if (lateralMm < -8) return deepBlood;
  const flesh = mixed(muscle, paleMuscle, 0.5 + 0.5 * fibre);
  if (lateralMm < 4) return mixed(deepBlood, mixed(capsule, flesh, 0.4 + 0.3 * fibre), (lateralMm + 8) / 10);
  if (lateralMm < 33 + 2 * fibre) return flesh;
  return mixed(flesh, fat, (lateralMm - 33 - 2 * fibre) / 3);
}

/** The floor and the skin's edge are even. */
const unevenShare = (lateralMm: number): number =>
  Math.max(0, Math.min(1, (lateralMm + 6) / 12, (skinMm - lateralMm) / 8));

/** Deep in a wound there is less light. */
const lightAt = (lateralMm: number): number => 0.42 + 0.58 * Math.min(Math.max((lateralMm + 12) / 50, 0), 1);

/** A point of the wall at a height, so far before it. */
export function onWall(angle: number, lateralMm: number, beforeMm: number): FieldPoint {
  const above = Math.max(
    1,
    levels.findIndex((level) => level.lateralMm >= lateralMm),
  );
  const [low, high] = [levels[above - 1], levels[above]] as [Level, Level];
  const share = (lateralMm - low.lateralMm) / (high.lateralMm - low.lateralMm);
  const [superior, anterior] = edgeBetween(low, high, share, angle);
  const before = 1 - beforeMm / Math.hypot(superior, anterior);
  return [superior * before, anterior * before, lateralMm];
}

/** Its walls and its floor, which leaves the bone out. */
export function woundGeometry(): BufferGeometry {
  const rows = new RingSurface(around);
  for (let i = 0; i + 1 < levels.length; ++i) {
    const [low, high] = [levels[i], levels[i + 1]] as [Level, Level];
    const last = i + 2 === levels.length ? 1 : 0;
    for (let part = 0; part < rowsPerLevel + last; ++part) {
      const share = part / rowsPerLevel;
      rows.add((angle) => {
        const at = edgeBetween(low, high, share, angle);
        const fibre = unevenness(angle, 2 * at[2]);
        const out = 1 + 0.035 * fibre * unevenShare(at[2]);
        return {
          at: [at[0] * out, at[1] * out, at[2]],
          colour: wallColour(at[2], fibre),
          light: lightAt(at[2]) * (1 + 0.12 * fibre),
        };
      });
    }
  }
  return rows.geometry();
}

/** A point so far beyond the wound's edge, on the skin. */
export function onSkin(angle: number, mm: number): FieldPoint {
  const [superior, anterior] = edge(levels.at(-1) as Level, angle);
  const from = Math.hypot(superior, anterior);
  const out = (from + mm) / from;
  const onBall = Math.min(mm, tentSlope * shoulderRadiusMm);
  const fall = onBall ** 2 / (2 * shoulderRadiusMm) + tentSlope * (mm - onBall);
  return [superior * out, anterior * out, skinMm - fall];
}

/** The skin around the wound, and the drape as far as anybody sees. */
export function coverGeometries(): { skin: BufferGeometry; drape: BufferGeometry } {
  const skinBand = new RingSurface(around);
  for (let row = 0; row <= skinRows; ++row)
    skinBand.add((angle) => ({
      at: onSkin(angle, (skinWideMm * row) / skinRows),
      colour: skin,
      light: 1 + 0.05 * unevenness(angle, 7 * row),
    }));
  const drape = new RingSurface(around);
  for (let row = 0; row <= drapeRows; ++row)
    drape.add((angle) => {
      const mm = skinWideMm - 1 + drapeWideMm * (row / drapeRows) ** 1.6;
      const [superior, anterior, lateral] = onSkin(angle, mm);
      // Its hem lies on the skin; then it stands off, and folds run outwards.
      const fold = unevenness(2 * angle, 0.05 * mm) * Math.min(1, (mm - skinWideMm) / 30);
      return {
        at: [superior, anterior, lateral + (row === 0 ? -0.5 : 1.6) + 3 * fold],
        colour: cloth,
        light: 1 + 0.1 * fold,
      };
    });
  return { skin: skinBand.geometry(), drape: drape.geometry() };
}
