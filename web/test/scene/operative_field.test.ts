import { DoubleSide, type Material, Mesh, MeshBasicMaterial, Raycaster, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { PlanFrame } from '../../src/practice/plan_frame';
import { fieldParts, OperativeField, restFromField, theatreViewMm } from '../../src/scene/operative_field';
import { surgeonsEye } from '../../src/scene/surgeon_eye';
import type { FieldPoint } from '../../src/scene/wound_shape';

/** Half the angle that the camera sees up and down, as OrbitCamera has it. */
const halfVerticalRad = (16 * Math.PI) / 180;

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

/** Of a glenoid of 38 by 25 mm: points on its rim, which stands a little before its middle. */
const rim: FieldPoint[] = Array.from({ length: 24 }, (_, i) => {
  const angle = (2 * Math.PI * i) / 24;
  return [19 * Math.cos(angle), (Math.sin(angle) > 0 ? 11 : 14) * Math.sin(angle), 2] as const;
});

/** Where the reamer is, so far beside the plan: the surgeon's eye follows it. */
const tools = [
  [0, 0],
  [8, 0],
  [-8, 0],
  [0, 8],
  [0, -8],
] as const;
/** Widths of the picture by its height. */
const aspects = [0.46, 1, 16 / 9, 21 / 9];

describe.each(['right', 'left'] as const)('around a %s glenoid', (side) => {
  const plan = sides[side];
  const { meshes, at } = field(plan);
  const seenFrom = (aspect: number, tool: readonly [number, number]) => {
    const { target, towardsEye, up } = surgeonsEye(plan, at([...tool, 0]));
    const halfHorizontalRad = Math.atan(Math.tan(halfVerticalRad) * aspect);
    const distance = theatreViewMm / Math.sin(Math.min(halfVerticalRad, halfHorizontalRad));
    return { eye: target.clone().addScaledVector(towardsEye, distance), target, towardsEye, up, distance };
  };
  const hidden = (eye: Vector3, point: FieldPoint) => {
    const to = at(point);
    const ray = new Raycaster(eye, to.clone().sub(eye).normalize(), 0, to.distanceTo(eye) - 0.5);
    return ray.intersectObjects(meshes).length > 0;
  };

  it.each(tools)('the surgeon sees the whole glenoid, the reamer %f and %f mm beside the plan', (...tool) => {
    for (const aspect of aspects) {
      const { eye } = seenFrom(aspect, tool);
      expect(rim.filter((point) => hidden(eye, point))).toEqual([]);
    }
  });

  it('acromion and spine of the demo are covered, and the patient’s skin', () => {
    const covered: FieldPoint[] = [
      [36, -4, 22],
      [34, -22, 19],
      [27, -34, 9],
      [10, -60, -20],
      [-40, 0, -10],
      [70, 60, 0],
      [-70, -60, 0],
    ];
    const { eye } = seenFrom(16 / 9, [0, 0]);
    expect(covered.filter((point) => !hidden(eye, point))).toEqual([]);
  });

  it.each(aspects)('nothing of the background is seen on a picture of %f', (aspect) => {
    for (const tool of tools) {
      const { eye, target, towardsEye, up, distance } = seenFrom(aspect, tool);
      const right = new Vector3().crossVectors(up, towardsEye).normalize();
      const upwards = new Vector3().crossVectors(towardsEye, right);
      const half = distance * Math.tan(halfVerticalRad);
      for (let across = -1; across <= 1; across += 0.125)
        for (let high = -1; high <= 1; high += 0.125) {
          const [x, y] = [half * aspect * across, half * high];
          const to = target.clone().addScaledVector(right, x).addScaledVector(upwards, y);
          // There is the bone.
          const isBone = Math.hypot(x, y) < 24;
          const hits = new Raycaster(eye, to.sub(eye).normalize()).intersectObjects(meshes);
          expect(isBone || hits.length > 0, `${across} ${high}`).toBe(true);
        }
    }
  });

  it('what is seen of each part faces the surgeon', () => {
    const { eye } = seenFrom(16 / 9, [0, 0]);
    const facing = meshes.map(() => ({ towards: 0, seen: 0 }));
    for (let superior = -70; superior <= 70; superior += 3.5)
      for (let anterior = -90; anterior <= 110; anterior += 3.5) {
        const ray = new Raycaster(eye, at([superior, anterior, 20]).sub(eye).normalize());
        const [hit] = ray.intersectObjects(meshes);
        const part = facing[meshes.indexOf(hit?.object as Mesh)];
        if (hit?.normal === undefined || part === undefined) continue;
        const normal = hit.normal.clone().transformDirection(hit.object.matrixWorld);
        part.towards -= normal.dot(ray.ray.direction);
        ++part.seen;
      }
    for (const { towards, seen } of facing) {
      expect(seen).toBeGreaterThan(3);
      expect(towards / seen).toBeGreaterThan(0.1);
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

describe('OperativeField', () => {
  /** How many of what it draws with now will have been disposed of. */
  function watchDisposal(of: OperativeField): () => number {
    let gone = 0;
    for (const { geometry, material } of of.group.children as Mesh[])
      for (const part of [geometry, material as Material]) part.addEventListener('dispose', () => ++gone);
    return () => gone;
  }

  it('is made when it is shown, and shown in theatre only', () => {
    const shown = new OperativeField();
    shown.setShown(true, false);
    expect(shown.group.visible).toBe(false);
    shown.setPlan(sides.right);
    shown.setShown(false, false);
    expect(shown.group.children.length).toBe(0);
    shown.setShown(true, false);
    expect(shown.group.visible).toBe(true);
    expect(shown.group.children.length).toBe(fieldParts().length);
    shown.setShown(false, false);
    expect(shown.group.visible).toBe(false);
    // Plates of a study of feel have no shoulder around them.
    shown.setPlan(null);
    shown.setShown(true, false);
    expect(shown.group.visible).toBe(false);
    expect(shown.group.children.length).toBe(0);
  });

  it('is made anew for another plan or level only, and disposes of the old one', () => {
    const shown = new OperativeField();
    shown.setPlan(sides.right);
    shown.setShown(true, false);
    const plainOnes = watchDisposal(shown);
    shown.setPlan(new PlanFrame({ axisEntryMm: [-150, -10, 20], axisDirection: [0.86, 0.5, -0.07] }));
    shown.setShown(true, false);
    expect(plainOnes()).toBe(0);
    shown.setShown(true, true);
    expect(plainOnes()).toBe(2 * fieldParts().length);
    const fullOnes = watchDisposal(shown);
    shown.setPlan(sides.left);
    expect(fullOnes()).toBe(2 * fieldParts().length);
    shown.setShown(true, true);
    expect(shown.group.children.length).toBe(fieldParts().length);
    const last = watchDisposal(shown);
    shown.dispose();
    expect(last()).toBe(2 * fieldParts().length);
  });
});
