import { Group, Matrix4, Quaternion, Vector3, type WebGLRenderer } from 'three';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { carried, grown, Headset, roomBefore, type Standpoint } from '../../src/scene/headset';

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

describe('a headset', () => {
  const nothing: Standpoint = { eye: new Vector3(1, 0, 0), target: new Vector3() };
  const bone: Standpoint = { eye: new Vector3(300, -40, 30), target };
  let controllers: Group[];
  let frame: (() => void) | null;
  let allow: () => void;

  beforeEach(() => {
    const session = { addEventListener: vi.fn(), inputSources: [] };
    const xr = {
      isSessionSupported: () => Promise.resolve(true),
      requestSession: () => new Promise((resolve) => (allow = () => resolve(session))),
      addEventListener: vi.fn(),
    };
    vi.stubGlobal('navigator', { xr });
    vi.stubGlobal('document', { createElement: () => ({ getContext: () => null }) });
    controllers = [new Group(), new Group()];
    frame = null;
  });
  afterEach(() => vi.unstubAllGlobals());

  function headset(): Headset {
    const xr = {
      enabled: false,
      getController: (i: number) => controllers[i],
      getSession: () => null,
      setReferenceSpaceType: vi.fn(),
      setSession: () => Promise.resolve(),
    };
    const renderer = { xr, setAnimationLoop: (loop: (() => void) | null) => void (frame = loop) };
    return new Headset(renderer as unknown as WebGLRenderer, vi.fn(), vi.fn());
  }
  const expectBeforeTheEyes = (worn: Headset) => close(seen(worn.room.matrix, target), new Vector3(0, 0, -0.55));

  it('places the wearer before a bone that arrives once it is worn', async () => {
    const worn = headset();
    const put = worn.putOn(() => nothing);
    allow();
    await put;
    expect(worn.worn.value).toBe(true);
    close(seen(worn.room.matrix, nothing.target), new Vector3(0, 0, -0.55));
    worn.place(bone);
    frame?.();
    expectBeforeTheEyes(worn);
  });

  it('begins at a bone that arrives while the browser still asks the person', async () => {
    const worn = headset();
    let from = nothing;
    const put = worn.putOn(() => from);
    from = bone;
    allow();
    await put;
    expectBeforeTheEyes(worn);
  });

  it('ends a grab where it places the wearer', async () => {
    const worn = headset();
    const put = worn.putOn(() => nothing);
    allow();
    await put;
    const [hand] = controllers;
    hand?.dispatchEvent({ type: 'selectstart' } as never);
    worn.place(bone);
    hand?.position.set(0.3, 0, 0);
    frame?.();
    expectBeforeTheEyes(worn);
  });
});
