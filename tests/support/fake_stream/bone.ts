/** A made-up scapula and a cap that reams it, as signed distances in mm (negative inside), in the grid frame. */
export type Point = [number, number, number];

export const dims: Point = [128, 160, 160];
export const spacingMm: Point = [0.5, 0.5, 0.5];
/** The glenoid faces +x; the axis goes through here along -x. */
export const entryMm: Point = [41.4, 40, 40];
export const plannedDepthMm = 2;

/** The cutting cap: half an ellipsoid, apex towards the bone. */
export const cap = { radiusMm: 18.25, heightMm: 9 };

function ellipsoid(p: Point, centre: Point, radii: Point): number {
  const scaled = Math.hypot(...p.map((v, i) => (v - (centre[i] ?? 0)) / (radii[i] ?? 1)));
  return (scaled - 1) * Math.min(...radii);
}

function smoothUnion(a: number, b: number, blendMm: number): number {
  const h = Math.max(blendMm - Math.abs(a - b), 0) / blendMm;
  return Math.min(a, b) - (h * h * blendMm) / 4;
}

export function intactBone(p: Point): number {
  const head = ellipsoid(p, [32, 40, 40], [13, 15, 20]);
  const neck = ellipsoid(p, [18, 40, 40], [18, 9, 14]);
  const blade = ellipsoid(p, [6, 42, 38], [14, 5, 36]);
  const coracoid = ellipsoid(p, [32, 26, 62], [7, 12, 6]);
  const cup = Math.hypot(p[0] - 75, p[1] - 40, p[2] - 40) - 33.6;
  const whole = smoothUnion(smoothUnion(smoothUnion(head, neck, 8), blade, 10), coracoid, 8);
  const pilot = Math.max(Math.hypot(p[1] - entryMm[1], p[2] - entryMm[2]) - 3.1, entryMm[0] - 12 - p[0]);
  return Math.max(whole, -cup, -pilot);
}

/** Distance to what the cap has swept when its apex is `depthMm` past the entry. */
export function sweptByCap(p: Point, depthMm: number): number {
  const centreX = entryMm[0] - depthMm + cap.heightMm;
  const q: Point = [Math.min(p[0], centreX), p[1], p[2]];
  return ellipsoid(q, [centreX, entryMm[1], entryMm[2]], [cap.heightMm, cap.radiusMm, cap.radiusMm]);
}
