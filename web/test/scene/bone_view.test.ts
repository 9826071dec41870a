import { Matrix4, Mesh, Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { BoneView } from '../../src/scene/bone_view';
import type { Pose } from '../../src/wire/messages';
import { hello } from '../wire/fake_messages';

const oneBlock = {
  blocks: [
    {
      block: 0,
      revision: 1,
      tick: 0,
      positions: new Uint16Array(12),
      normals: new Int16Array(12),
      indices: new Uint16Array([0, 1, 2]),
    },
  ],
  keyComplete: true,
};

/** Where a vertex step of the first block is drawn. */
function drawnAt(view: BoneView, step: Vector3): Vector3 {
  view.group.updateMatrixWorld(true);
  let matrix: Matrix4 | null = null;
  view.group.traverse((part) => {
    if (part instanceof Mesh) matrix = part.matrixWorld;
  });
  if (matrix === null) throw new Error('no block is shown');
  return step.clone().applyMatrix4(matrix);
}

function shownBone(): BoneView {
  const view = new BoneView();
  const message = hello({ worldFromGrid: { rotationXyzw: [0, 0, 0, 1], translationMm: [10, 20, 30] } });
  if (message.kind !== 'hello') throw new Error('not a hello');
  view.begin(message.hello);
  view.apply(oneBlock);
  return view;
}

describe('BoneView', () => {
  it('moves the whole bone by the displacement of the stream', () => {
    const view = shownBone();
    const rest = drawnAt(view, new Vector3(2048, 1024, 3072));
    expect(rest.toArray()).toEqual([11, 20, 32]);
    const quarterTurn = new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), Math.PI / 2);
    const moved: Pose = {
      rotationXyzw: [quarterTurn.x, quarterTurn.y, quarterTurn.z, quarterTurn.w],
      translationMm: [1, -2, 3],
    };
    view.setPose(moved);
    const there = drawnAt(view, new Vector3(2048, 1024, 3072));
    expect(there.x).toBeCloseTo(-20 + 1, 9);
    expect(there.y).toBeCloseTo(11 - 2, 9);
    expect(there.z).toBeCloseTo(32 + 3, 9);
  });

  it('puts it back where it rests', () => {
    const view = shownBone();
    view.setPose({ rotationXyzw: [1, 0, 0, 0], translationMm: [5, 5, 5] });
    view.setPose(null);
    expect(drawnAt(view, new Vector3(1024, 1024, 1024)).toArray()).toEqual([10, 20, 30]);
  });
});
