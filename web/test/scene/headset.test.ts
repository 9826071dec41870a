import { Matrix4, Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { carried, grown, roomBefore } from '../../src/scene/headset';

const target = new Vector3(100, -40, 30);
const close = (a: Vector3, b: Vector3) => expect(a.distanceTo(b)).toBeLessThan(1e-6);
/** Where a place of the world is for the wearer, metres. */
const seen = (room: Matrix4, place: Vector3) => place.clone().applyMatrix4(room.clone().invert());

describe('the room of a headset', () => {
  it('has the bone before the eyes, upright and enlarged, from whichever height it was seen', () => {
    for (const eye of [new Vector3(300, -40, 30), new Vector3(200, 60, 400), new Vector3(100, -40, 400)]) {
      const room = roomBefore({ eye, target }, 4);
      close(seen(room, target), new Vector3(0, 0, -0.55));
      close(seen(room, target.clone().add(new Vector3(0, 0, 10))), new Vector3(0, 0.04, -0.55));
    }
  });

  it('keeps what a hand has grabbed in the hand', () => {
    const room = roomBefore({ eye: new Vector3(300, -40, 30), target }, 4);
    const pose = (x: number, turn: number) =>
      new Matrix4().compose(
        new Vector3(x, -0.2, -0.4),
        new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), turn),
        new Vector3(1, 1, 1),
      );
    const [then, now] = [pose(0.1, 0), pose(-0.15, 0.7)];
    const inHand = (world: Matrix4, hand: Matrix4) => seen(world, target).applyMatrix4(hand.clone().invert());
    close(inHand(carried(room, then, now), now), inHand(room, then));
    expect(carried(room, then, then).elements[12]).toBeCloseTo(room.elements[12] ?? NaN, 9);
  });

  it('grows around what is before the head, and within limits', () => {
    const room = roomBefore({ eye: new Vector3(300, -40, 30), target }, 4);
    const head = new Matrix4();
    const larger = grown(room, head, 2);
    close(seen(larger, target), seen(room, target));
    close(seen(larger, target.clone().add(new Vector3(0, 0, 10))), new Vector3(0, 0.08, -0.55));
    const most = grown(room, head, 1e6);
    expect(1000 / new Vector3().setFromMatrixScale(most).x).toBeCloseTo(20, 6);
  });
});
