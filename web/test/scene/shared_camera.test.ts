import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { PlanFrame } from '../../src/practice/plan_frame';
import { SharedCamera } from '../../src/scene/shared_camera';
import type { Eye } from '../../src/scene/shared_eye';

/** A picture that is drawn whenever it is seen from elsewhere. */
class FakeScene {
  planFrame: PlanFrame | null;
  drawn = 0;
  private at: Eye = {
    target: new Vector3(),
    towardsEye: new Vector3(1, 0, 0),
    up: new Vector3(0, 0, 1),
    distanceMm: 100,
  };
  constructor(
    private readonly camera: SharedCamera,
    entry: [number, number, number] = [0, 0, 0],
  ) {
    this.planFrame = new PlanFrame({ axisEntryMm: entry, axisDirection: [-1, 0, 0] });
    camera.add(this);
  }
  eye = () => this.at;
  setEye(eye: Eye): void {
    this.at = eye;
    if (++this.drawn < 20) this.camera.onDrawn(this);
  }
  /** By hand. */
  turn(change: Partial<Eye>): void {
    this.at = { ...this.at, ...change };
    this.camera.onDrawn(this);
  }
}

describe('shared camera', () => {
  it('moves all others with the one that is turned, without end being called for', () => {
    const camera = new SharedCamera();
    const [a, b] = [new FakeScene(camera), new FakeScene(camera, [50, 0, 0])];
    camera.onDrawn(a);
    camera.onDrawn(b);
    b.turn({ distanceMm: 70, towardsEye: new Vector3(0, 1, 0) });
    expect(a.eye().distanceMm).toBe(70);
    expect(a.eye().towardsEye.distanceTo(new Vector3(0, 1, 0))).toBeLessThan(1e-9);
    expect(
      a.eye().target.distanceTo(
        b
          .eye()
          .target.clone()
          .sub(new Vector3(50, 0, 0)),
      ),
    ).toBeLessThan(1e-9);
    expect(a.drawn + b.drawn).toBeLessThan(6);
  });

  it('shows who comes later from where the others are', () => {
    const camera = new SharedCamera();
    const a = new FakeScene(camera);
    a.turn({ distanceMm: 60 });
    const b = new FakeScene(camera);
    camera.onDrawn(b);
    expect(b.eye().distanceMm).toBe(60);
    expect(a.eye().distanceMm).toBe(60);
  });

  it('leaves alone who has left, and who has no bone yet', () => {
    const camera = new SharedCamera();
    const [a, b] = [new FakeScene(camera), new FakeScene(camera)];
    b.planFrame = null;
    a.turn({ distanceMm: 60 });
    expect(b.eye().distanceMm).toBe(100);
    camera.remove(a);
    a.turn({ distanceMm: 30 });
    expect(b.eye().distanceMm).toBe(100);
  });
});
