import {
  BufferGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshStandardMaterial,
  Vector3,
} from 'three';

import type { Outline } from '../ct/reamer_shape';
import type { PlanMark } from '../state/case/view_marks';

const axisLengthMm = { outside: 50, inside: 30 };
const sides = 48;
const planColour = 0x0b8f6a;

/** The axis of a plan and the reamer where its planned depth is reached; world frame. */
export function planMeshes(plan: PlanMark): Group {
  const group = new Group();
  group.position.set(...plan.entry);
  group.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...plan.direction).normalize());
  const ends = [new Vector3(0, 0, -axisLengthMm.outside), new Vector3(0, 0, axisLengthMm.inside)];
  const axis = new Line(
    new BufferGeometry().setFromPoints(ends),
    new LineBasicMaterial({ color: planColour, depthTest: false, transparent: true, opacity: 0.8 }),
  );
  axis.renderOrder = 1;
  const look = { color: planColour, transparent: true, opacity: plan.kept ? 0.35 : 0.2, side: DoubleSide };
  const reamer = new Mesh(
    revolved(plan.outline, plan.depthMm),
    new MeshStandardMaterial({ ...look, depthWrite: false }),
  );
  group.add(axis, reamer);
  return group;
}

/** The outline turned around z, its apex at the depth. */
function revolved(outline: Outline, depthMm: number): BufferGeometry {
  const positions: number[] = [];
  const indices: number[] = [];
  outline.forEach(({ offAxisMm, behindMm }, ring) => {
    for (let side = 0; side < sides; ++side) {
      const angle = (side / sides) * Math.PI * 2;
      positions.push(Math.cos(angle) * offAxisMm, Math.sin(angle) * offAxisMm, depthMm - behindMm);
      if (ring === 0) continue;
      const next = (side + 1) % sides;
      const [a, b, c, d] = [
        (ring - 1) * sides + side,
        (ring - 1) * sides + next,
        ring * sides + side,
        ring * sides + next,
      ];
      indices.push(a, c, b, b, c, d);
    }
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(positions, 3));
  geometry.setIndex(indices);
  geometry.computeVertexNormals();
  return geometry;
}
