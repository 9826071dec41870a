import { Matrix4, Mesh, Quaternion, Vector3 } from 'three';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { BoneView } from '../../src/scene/bone_view';
import type { MeshDelta, Pose } from '../../src/wire/messages';
import { hello } from '../wire/fake_messages';

const delta = (blocks: number[], revision: number, keyComplete: boolean): MeshDelta => ({
  blocks: blocks.map((block) => ({
    block,
    revision,
    tick: 0,
    positions: new Uint16Array(12),
    normals: new Int16Array(12),
    indices: new Uint16Array([0, 1, 2]),
  })),
  keyComplete,
});

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

function shownBone(onSettled = () => undefined as void): BoneView {
  const view = new BoneView(onSettled);
  const message = hello({
    gridDims: [512, 64, 64],
    worldFromGrid: { rotationXyzw: [0, 0, 0, 1], translationMm: [10, 20, 30] },
  });
  if (message.kind !== 'hello') throw new Error('not a hello');
  view.begin(message.hello);
  view.apply(delta([0], 1, true));
  return view;
}

describe('BoneView', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it('tells of each region that is drawn otherwise, so that none waits for the next picture', () => {
    const meshMessages: number[] = [];
    const view: BoneView = shownBone(() => meshMessages.push(view.group.children[0]?.children.length ?? NaN));
    vi.advanceTimersByTime(10_000);
    expect(meshMessages).toEqual([1]);
    // Two blocks in each of three regions.
    view.apply(delta([4, 5, 8, 9, 12, 13], 2, false));
    vi.advanceTimersByTime(1000);
    expect(meshMessages).toEqual([1]);
    vi.advanceTimersByTime(10_000);
    expect(meshMessages).toEqual([1, 6, 5, 4]);
    view.dispose();
  });

  it('waits for surfaces of fewer triangles that follow, and draws those together', () => {
    const view = shownBone();
    const meshes = () => view.group.children[0]?.children.length ?? NaN;
    const blocks = Array.from({ length: 16 }, (_, i) => i);
    view.apply({ ...delta(blocks, 2, true), simplerFollow: true });
    vi.advanceTimersByTime(1000);
    expect(meshes(), 'each by itself').toBeGreaterThanOrEqual(16);
    view.simplify(delta(blocks, 2, false).blocks);
    vi.advanceTimersByTime(1000);
    expect(meshes()).toBe(4);
    view.dispose();
  });

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
