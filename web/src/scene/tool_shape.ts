import type { BufferGeometry } from 'three';

import type { MeridianPoint } from './meridian';
import { type Grid, SolidShapes, turned } from './solid_shapes';
import { faceHeightMm, type ToolProfile } from './tool_profile';

/** As server/force/coefficients.hpp has the lips: so many, straight, and past the axis at this share of the rim. */
export const lipCount = 5;
export const lipAngleDeg = 9.46;
const lipOffsetShare = Math.sin((lipAngleDeg * Math.PI) / 180);
export const lipPitchRad = (2 * Math.PI) / lipCount;

/** Behind its lip a blade goes on for so much of the way to the next lip; the rest is open to the bone. */
const bladeShare = 0.46;
const bladeColumns = 7;
const toothMm = 2.6;
const notch = { widthMm: 0.7, flankMm: 0.2, deepMm: 0.6 };
/** How far a blade falls back behind its lip, and how thick it is there; of a thin wall at most this share. */
const reliefMm = 0.9;
const plateMm = 1.5;
const ribMm = 4;
const shareOfWall = 0.35;
/** What does not cut stands back by this, so that nothing lies in the envelope but lips. */
const insetMm = 0.02;
const bodyInsetMm = 0.35;
/** The lips' ends stand out of the rim by so much less, so that both are told apart. */
const rimInsetMm = 0.14;
const rimWallMm = 1.3;
const hubWallMm = 1.4;
const boreMm = 1.3;
const sides = 60;
const stepMm = 1.2;
/** Rings that teeth in a blur leave. */
const ringMm = toothMm / 2;

/** All of the length behind the head. The shaft is as long as it is drawn for other reamers. */
const collar = { radiusMm: 3.8, lengthMm: 6 };
/** No wider: who looks along it sees the bone past it. */
const shaftMm = 2.5;
const chuck = { radiusMm: 3.5, lengthMm: 15 };
const lengthMm = 47;

/** The lips with their blades, which turn: their edges lie on the envelope, nothing of them outside. */
export function bladesOf(profile: ToolProfile): BufferGeometry {
  const shapes = new SolidShapes();
  for (let blade = 0; blade < lipCount; ++blade) {
    const { front, back } = bladePlate(profile, blade);
    shapes.addPlate(front, back);
  }
  return shapes.geometry();
}

/** What looks the same however it is turned: nipple or bore, hub, rim, collar, shaft and chuck. */
export function bodyOf(profile: ToolProfile): BufferGeometry {
  const shapes = new SolidShapes();
  shapes.addTurned([...centre(profile), ...handle(profile)], sides);
  shapes.addTurned(rim(profile), 2 * sides);
  return shapes.geometry();
}

/** What cuts and what guides, all around: how far the reamer reaches. Seen from both sides. */
export function envelopeOf({ nipple, face }: ToolProfile): BufferGeometry {
  const shapes = new SolidShapes();
  shapes.addTurned([...nipple, ...(nipple.length > 0 ? face.slice(1) : face)], sides);
  return shapes.geometry();
}

/** Where the blades are seen while they turn too fast to be told apart. */
export function sweptOf(profile: ToolProfile): BufferGeometry {
  const shapes = new SolidShapes();
  const { relief } = depths(profile);
  const at = (offMm: number, backMm: number) => ({
    offMm,
    zMm: Math.max(faceHeightMm(profile, offMm) - backMm, profile.backZMm + insetMm),
  });
  const ring = (offMm: number) => relief * (0.5 + 0.4 * Math.sin((2 * Math.PI * offMm) / ringMm));
  const front = bladeRadii(profile, ringMm / 4).map((offMm) => at(offMm, insetMm + ring(offMm)));
  const back = bladeRadii(profile, stepMm).map((offMm) => at(offMm, relief + plateMm));
  shapes.addTurned([...front, ...back.reverse()], sides);
  return shapes.geometry();
}

export const hubMm = (profile: ToolProfile): number =>
  Math.max((profile.nipple.at(-1)?.offMm ?? boreMm) + hubWallMm, 1.25 * lipOffsetShare * profile.rimMm);

function depths({ face, backZMm }: ToolProfile) {
  const wallMm = (face.at(-1)?.zMm ?? 0) - backZMm;
  return { relief: Math.min(reliefMm, shareOfWall * wallMm), notched: Math.min(notch.deepMm, shareOfWall * wallMm) };
}

/** Where a lip is at this distance from the axis: a straight line that passes the axis at its offset. */
const lipAngle = (profile: ToolProfile, blade: number, offMm: number): number =>
  blade * lipPitchRad + Math.asin(Math.min((lipOffsetShare * profile.rimMm) / offMm, 1));

/** Where the notches between a lip's teeth begin; those of neighbouring lips lie apart, so that no bone is left. */
const notchesOf = (profile: ToolProfile, blade: number): number[] => {
  const first = hubMm(profile) + 0.5 + (((2 * blade) % lipCount) / lipCount) * toothMm;
  const count = Math.max(Math.floor((profile.rimMm - 1 - first) / toothMm) + 1, 0);
  return Array.from({ length: count }, (_, i) => first + i * toothMm);
};

function notchMm(notches: number[], offMm: number): number {
  const inside = notches.map((from) => Math.min(offMm - from, from + notch.widthMm - offMm));
  return Math.min(Math.max(...inside, 0) / notch.flankMm, 1);
}

/** Where the outline of a blade with such notches bends, from its hub to the rim, with no wider steps. */
function bladeRadii(profile: ToolProfile, widestMm: number, notches: number[] = []): number[] {
  const { widthMm, flankMm } = notch;
  const [from, to] = [hubMm(profile) - 0.3, profile.rimMm - insetMm];
  const steps = Math.ceil((to - from) / widestMm);
  const radii = [
    ...Array.from({ length: steps + 1 }, (_, i) => from + ((to - from) * i) / steps),
    ...profile.face.map(({ offMm }) => offMm),
    ...notches.flatMap((at) => [0, flankMm, widthMm - flankMm, widthMm].map((along) => at + along)),
  ];
  const ordered = radii.filter((offMm) => offMm >= from && offMm <= to).sort((a, b) => a - b);
  return ordered.filter((offMm, i) => i === 0 || offMm - (ordered[i - 1] ?? 0) > 1e-3);
}

function bladePlate(profile: ToolProfile, blade: number): { front: Grid; back: Grid } {
  const { relief, notched } = depths(profile);
  const notches = notchesOf(profile, blade);
  const least = profile.backZMm + insetMm;
  const rows = bladeRadii(profile, stepMm, notches).map((offMm) => {
    const heightMm = faceHeightMm(profile, offMm);
    const cutMm = notched * notchMm(notches, offMm);
    const columns = Array.from({ length: bladeColumns }, (_, j) => {
      const behind = j / (bladeColumns - 1);
      const angle = lipAngle(profile, blade, offMm) - behind * bladeShare * lipPitchRad;
      const thickMm = j < 2 ? ribMm : plateMm + relief;
      const top = heightMm - cutMm - relief * behind;
      return {
        front: turned(offMm, angle, Math.max(top, least)),
        back: turned(offMm, angle, Math.max(heightMm - thickMm, least)),
      };
    });
    // By angles that grow, as a plate has them.
    return columns.reverse();
  });
  return {
    front: rows.map((row) => row.map(({ front }) => front)),
    back: rows.map((row) => row.map(({ back }) => back)),
  };
}

/** Nipple, or the bore for a guide pin, and the hub down to the head's back. */
function centre(profile: ToolProfile): MeridianPoint[] {
  const outer = hubMm(profile);
  const face = (offMm: number) => faceHeightMm(profile, offMm) - bodyInsetMm;
  const hub = [
    { offMm: outer, zMm: face(outer) },
    { offMm: outer, zMm: profile.backZMm - 0.6 },
  ];
  const { nipple } = profile;
  if (nipple.length === 0) {
    const bottom = profile.backZMm;
    const bore = [0, boreMm].map((offMm) => ({ offMm, zMm: bottom }));
    return [...bore, { offMm: boreMm, zMm: face(boreMm) }, ...hub];
  }
  return [...rounded(nipple), { offMm: nipple.at(-1)?.offMm ?? 0, zMm: face(nipple.at(-1)?.offMm ?? 0) }, ...hub];
}

/** The nipple just within its envelope, with the edge of its tip taken off. */
function rounded(nipple: readonly MeridianPoint[]): MeridianPoint[] {
  return nipple.flatMap((point, i) => {
    const inner = { offMm: Math.max(point.offMm - insetMm, 0), zMm: point.zMm - insetMm };
    const [before, after] = [nipple[i - 1], nipple[i + 1]];
    const isTip = before !== undefined && after !== undefined && before.zMm === point.zMm && before.offMm === 0;
    if (!isTip) return [inner];
    const edgeMm = Math.min(0.9, point.offMm / 2, (point.zMm - after.zMm) / 2);
    return [0, 0.5, 1].map((share) => ({
      offMm: inner.offMm - edgeMm * (1 - Math.sin((share * Math.PI) / 2)),
      zMm: inner.zMm - edgeMm * (1 - Math.cos((share * Math.PI) / 2)),
    }));
  });
}

function rim(profile: ToolProfile): MeridianPoint[] {
  const [outer, inner] = [profile.rimMm - rimInsetMm, profile.rimMm - rimWallMm];
  const { notched } = depths(profile);
  const top = (offMm: number) => Math.max(faceHeightMm(profile, offMm) - notched, profile.backZMm + 0.2);
  const back = profile.backZMm + insetMm;
  return [
    { offMm: inner, zMm: back },
    { offMm: inner, zMm: top(inner) },
    { offMm: outer, zMm: top(outer) },
    { offMm: outer, zMm: back },
    { offMm: inner, zMm: back },
  ];
}

/** From the head's back to the end of the chuck, each place by its distance behind the head. */
function handle(profile: ToolProfile): MeridianPoint[] {
  const hub = hubMm(profile);
  const collarMm = Math.min(collar.radiusMm, hub);
  const collarEnd = 2 + collar.lengthMm;
  const chuckFrom = lengthMm - chuck.lengthMm;
  const groove = (from: number): [number, number][] => [
    [chuck.radiusMm, from],
    [chuck.radiusMm - 0.4, from + 0.3],
    [chuck.radiusMm - 0.4, from + 0.9],
    [chuck.radiusMm, from + 1.2],
  ];
  const outline: [offMm: number, behindMm: number][] = [
    [collarMm, 2],
    [collarMm, collarEnd - 0.6],
    [shaftMm, collarEnd],
    [shaftMm, chuckFrom],
    [shaftMm + 0.2, chuckFrom + 0.3],
    [chuck.radiusMm, chuckFrom + 2.5],
    ...[5, 8, 11].flatMap((at) => groove(chuckFrom + at)),
    [chuck.radiusMm, lengthMm - 0.8],
    [chuck.radiusMm - 0.8, lengthMm],
    [0, lengthMm],
  ];
  return outline.map(([offMm, behindMm]) => ({ offMm, zMm: profile.backZMm - behindMm }));
}
