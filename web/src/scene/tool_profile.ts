import type { ToolMesh } from '../wire/messages';
import { meridianOf, type MeridianPoint } from './meridian';

/** A reamer that turns: what of its outline cuts, what guides it, and where its head ends. Tool frame. */
export interface ToolProfile {
  /** From its tip on the axis to its foot on the face; empty: there is none. */
  nipple: readonly MeridianPoint[];
  /** From the axis, or from the nipple's foot, out to the rim; ever further from the axis. */
  face: readonly MeridianPoint[];
  rimMm: number;
  /** Where the wall behind the rim ends. */
  backZMm: number;
}

/** So near to the largest radius the outline is at the rim. */
const atRimMm = 0.01;
/** A rim that is thinner has no room for teeth. */
const leastWallMm = 0.5;
/** A nipple's wall is so much steeper than any face, higher, and nearer to the axis than this share of the rim. */
const nippleWall = { steepness: 3, heightMm: 1, within: 0.5 };

/** Null: the mesh is no reamer that turns around its axis with a face and a wall behind it. */
export function profileOf(tool: ToolMesh): ToolProfile | null {
  const outline = meridianOf(tool);
  if (outline === null) return null;
  const rimMm = Math.max(...outline.map(({ offMm }) => offMm));
  const isRim = ({ offMm }: MeridianPoint) => offMm >= rimMm - atRimMm;
  const rim = outline.findIndex(isRim);
  const backZMm = outline[outline.map(isRim).lastIndexOf(true)]?.zMm ?? 0;
  const foot = nippleFoot(outline.slice(0, rim + 1), rimMm);
  const face = outline.slice(foot, rim + 1);
  const outwards = face.every(({ offMm }, i) => i === 0 || offMm >= (face[i - 1]?.offMm ?? 0));
  if (face.length < 2 || !outwards || (face.at(-1)?.zMm ?? 0) - backZMm < leastWallMm) return null;
  return { nipple: foot > 0 ? outline.slice(0, foot + 1) : [], face, rimMm, backZMm };
}

/** Where the last steep wall near the axis ends; 0: there is none. */
function nippleFoot(front: MeridianPoint[], rimMm: number): number {
  return Math.max(front.map((point, i) => isWall(front[i - 1], point, rimMm)).lastIndexOf(true), 0);
}

function isWall(before: MeridianPoint | undefined, point: MeridianPoint, rimMm: number): boolean {
  if (before === undefined || point.offMm > nippleWall.within * rimMm) return false;
  const fallMm = before.zMm - point.zMm;
  return fallMm >= nippleWall.heightMm && fallMm > nippleWall.steepness * Math.abs(point.offMm - before.offMm);
}

/** How high the face stands at a distance from the axis; beyond its ends as at them. */
export function faceHeightMm({ face }: ToolProfile, offMm: number): number {
  const next = face.findIndex((point) => point.offMm >= offMm);
  const [from, to] = [face[next - 1], face[next]];
  if (to === undefined) return face.at(-1)?.zMm ?? 0;
  if (from === undefined) return to.zMm;
  return from.zMm + ((to.zMm - from.zMm) * (offMm - from.offMm)) / (to.offMm - from.offMm);
}
