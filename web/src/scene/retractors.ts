import { type BufferGeometry, CatmullRomCurve3, TubeGeometry, Vector3 } from 'three';

import { humerusCut } from './humerus';
import { type Grid, SolidShapes } from './solid_shapes';
import { type FieldPoint, onSkin, onWall } from './wound_shape';

const bladeThickMm = 1.4;
/** The wall is uneven. */
const wallGapMm = 3.5;
/** Where the ring is held. */
const ringAngle = 4.6;
const parts = 26;

/** A bent steel blade along a curve, which faces `away` from what it holds back. */
function addBlade(
  shapes: SolidShapes,
  along: readonly FieldPoint[],
  wideMm: (share: number) => number,
  side: Vector3,
): void {
  const curve = new CatmullRomCurve3(along.map((point) => new Vector3(...point)));
  const rows = (offMm: number): Grid =>
    Array.from({ length: parts + 1 }, (_, i) => {
      const share = i / parts;
      const at = curve.getPoint(share);
      const away = new Vector3().crossVectors(curve.getTangent(share), side).normalize();
      // A little hollow, as blades are.
      return [-1, -0.5, 0, 0.5, 1].map((across) => {
        const hollow = 0.9 * (across ** 2 - 1);
        const place = at
          .clone()
          .addScaledVector(side, (across * wideMm(share)) / 2)
          .addScaledVector(away, offMm + hollow);
        return [place.x, place.y, place.z] as const;
      });
    });
  shapes.addPlate(rows(bladeThickMm), rows(0));
}

/** Along the wall from behind the rim, over the skin's edge, and away to whoever holds it. */
function alongWall(angle: number): FieldPoint[] {
  const lifted = (mm: number, byMm: number): FieldPoint => {
    const [superior, anterior, lateral] = onSkin(angle, mm);
    return [superior, anterior, lateral + byMm];
  };
  return [
    onWall(angle, -11, 6),
    ...[-6, 3, 14, 27, 39].map((lateralMm) => onWall(angle, lateralMm, wallGapMm)),
    lifted(-1, 5),
    lifted(14, 7),
    lifted(70, 9),
    lifted(130, 30),
  ];
}

/** Square to the direction in which a blade at that angle holds. */
const beside = (angle: number) => new Vector3(-Math.sin(angle), Math.cos(angle), 0);

/** Blades at the anterior, the superior and the inferior rim, hooked behind it. */
export function bladesGeometry(): BufferGeometry {
  const shapes = new SolidShapes();
  const blade = (share: number) => (share < 0.1 ? 5 + 90 * share : share < 0.55 ? 14 : 14 - 8 * (share - 0.55));
  for (const [angle, size] of [
    [1.5, 1],
    [-0.62, 0.75],
    [3.05, 0.8],
  ] as const)
    addBlade(shapes, alongWall(angle), (share) => size * blade(share), beside(angle));
  const angle = ringAngle;
  addBlade(shapes, [ringPoint(Math.PI / 2), ...alongWall(angle).slice(5)], () => 7, beside(angle));
  return shapes.geometry();
}

/** A ring retractor that holds the humerus back, before its cut surface. */
export function ringGeometry(): BufferGeometry {
  const points = Array.from({ length: 24 }, (_, i) => new Vector3(...ringPoint((2 * Math.PI * i) / 24)));
  return new TubeGeometry(new CatmullRomCurve3(points, true), 72, 1.7, 8, true);
}

function ringPoint(angle: number): FieldPoint {
  const { centre, towards, across, other } = humerusCut;
  const at = new Vector3(...centre)
    .addScaledVector(towards, 3)
    .addScaledVector(across, 15 * Math.cos(angle))
    .addScaledVector(other, 19 * Math.sin(angle));
  return [at.x, at.y, at.z];
}
