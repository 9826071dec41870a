import { DoubleSide, Mesh, MeshBasicMaterial, Raycaster, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { PlanFrame } from '../../src/practice/plan_frame';
import { fieldParts, restFromField } from '../../src/scene/operative_field';
import type { FieldPoint } from '../../src/scene/wound_shape';
import { surgeonsEye } from '../../src/scene/surgeon_eye';

/** From where the whole wound is seen, mm. */
const eyeMm = 195;

const sides = {
  right: new PlanFrame({ axisEntryMm: [-150, -10, 20], axisDirection: [0.86, 0.5, -0.07] }),
  left: new PlanFrame({ axisEntryMm: [150, -10, 20], axisDirection: [-0.86, 0.5, -0.07] }),
};

function field(plan: PlanFrame): { meshes: Mesh[]; at: (point: FieldPoint) => Vector3 } {
  const rest = restFromField(plan);
  const meshes = fieldParts().map(([geometry]) => {
    const mesh = new Mesh(geometry, new MeshBasicMaterial({ side: DoubleSide }));
    mesh.matrixAutoUpdate = false;
    mesh.matrix.copy(rest);
    mesh.updateMatrixWorld(true);
    return mesh;
  });
  return { meshes, at: (point) => new Vector3(...point).applyMatrix4(rest) };
}

/** Of a glenoid of 38 by 28 mm: points on its rim, which stands a little before its middle, and in it. */
const glenoid: FieldPoint[] = Array.from({ length: 24 }, (_, i) => {
  const angle = (2 * Math.PI * i) / 24;
  return [19 * Math.cos(angle), (Math.cos(angle) > 0 ? 11 : 14) * Math.sin(angle), 2] as const;
});

describe.each(['right', 'left'] as const)('around a %s glenoid', (side) => {
  const plan = sides[side];
  const { meshes, at } = field(plan);
  const { target, towardsEye } = surgeonsEye(plan, null);
  const eye = target.clone().addScaledVector(towardsEye, eyeMm);
  const hidden = (point: FieldPoint) => {
    const to = at(point);
    const ray = new Raycaster(eye, to.clone().sub(eye).normalize(), 0, to.distanceTo(eye) - 0.5);
    return ray.intersectObjects(meshes).length > 0;
  };

  it('the surgeon sees the whole glenoid', () => {
    expect(glenoid.filter(hidden)).toEqual([]);
  });

  it('acromion, spine and the patient’s skin are covered', () => {
    const covered: FieldPoint[] = [
      [36, -4, 22],
      [34, -22, 19],
      [27, -34, 9],
      [10, -60, -20],
      [-40, 0, -10],
      [70, 60, 0],
      [-70, -60, 0],
    ];
    expect(covered.filter((point) => !hidden(point))).toEqual([]);
  });

  it('nothing of the background is seen', () => {
    const { up } = surgeonsEye(plan, null);
    const right = new Vector3().crossVectors(up, towardsEye).normalize();
    const upwards = new Vector3().crossVectors(towardsEye, right);
    // Half the height and half the width of a picture of 21 by 9, at the glenoid.
    for (let across = -1; across <= 1; across += 0.1)
      for (let high = -1; high <= 1; high += 0.1) {
        const to = target
          .clone()
          .addScaledVector(right, 135 * across)
          .addScaledVector(upwards, 58 * high);
        const bone = Math.hypot(135 * across, 58 * high) < 20;
        const hits = new Raycaster(eye, to.sub(eye).normalize()).intersectObjects(meshes);
        expect(bone || hits.length > 0, `${across} ${high}`).toBe(true);
      }
  });

  it('a reamer of 38 mm goes in and out along the planned axis', () => {
    for (let lateral = 0; lateral <= 60; lateral += 2)
      for (let i = 0; i < 32; ++i) {
        const angle = (2 * Math.PI * i) / 32;
        const axis = at([0, 0, lateral]);
        const towards = at([Math.cos(angle), Math.sin(angle), lateral]).sub(axis);
        const hits = new Raycaster(axis, towards, 0, 19).intersectObjects(meshes);
        expect(hits.length, `${lateral} mm before the entry, towards ${angle}`).toBe(0);
      }
  });
});
