import { BoxGeometry, BufferAttribute, BufferGeometry, Group, Mesh, Plane, SphereGeometry, Vector3 } from 'three';
import { MeshBVH } from 'three-mesh-bvh';
import { describe, expect, it } from 'vitest';

import { pickBone } from '../../src/scene/bone_picker';
import { haveBoxes } from '../../src/scene/line_hits';

const ray = (origin: [number, number, number], direction: [number, number, number]) => ({
  origin: new Vector3(...origin),
  direction: new Vector3(...direction).normalize(),
});

function bone(): { group: Group; ball: Mesh; box: Mesh } {
  const group = new Group();
  const ball = new Mesh(new SphereGeometry(10, 96, 64));
  const box = new Mesh(new BoxGeometry(4, 4, 4));
  ball.position.set(0, 0, 0);
  box.position.set(30, 0, 0);
  group.add(ball, box);
  return { group, ball, box };
}

describe('places of the bone', () => {
  it('are where the sight first meets it', () => {
    const { group, ball, box } = bone();
    const far = pickBone(group, ray([100, 0, 0], [-1, 0, 0]), []);
    expect(far?.mesh).toBe(box);
    expect(far?.place[0]).toBeCloseTo(32);
    const near = pickBone(group, ray([-100, 3, 1], [1, 0, 0]), []);
    expect(near?.mesh).toBe(ball);
    expect(Math.hypot(...(near?.place ?? [0]))).toBeCloseTo(10, 1);
    expect(pickBone(group, ray([100, 20, 0], [-1, 0, 0]), [])).toBeNull();
  });

  it('stay with a bone that has moved', () => {
    const { group } = bone();
    group.position.set(0, 5, 0);
    group.rotation.z = Math.PI / 2; // the box is upwards now
    const found = pickBone(group, ray([0, 100, 0], [0, -1, 0]), []);
    expect(found?.place[0]).toBeCloseTo(32);
    expect(found?.place[1]).toBeCloseTo(0);
  });

  it('are not on what is cut away, and may be on the inside then', () => {
    const { group, ball } = bone();
    // Bone with x > 0 is cut away.
    const cut = new Plane().setFromNormalAndCoplanarPoint(new Vector3(-1, 0, 0), new Vector3(0, 0, 0));
    const found = pickBone(group, ray([100, 0, 1], [-1, 0, 0]), [cut]);
    expect(found?.mesh).toBe(ball);
    expect(found?.place[0]).toBeLessThan(-9.8);
  });

  it('are not on what is hidden', () => {
    const { group, ball, box } = bone();
    box.visible = false;
    expect(pickBone(group, ray([100, 0, 0], [-1, 0, 0]), [])?.mesh).toBe(ball);
  });

  it('agree with every triangle tried one by one, on a surface whose boxes were made elsewhere', () => {
    const source = new SphereGeometry(10, 40, 30);
    const positions = (source.getAttribute('position').array as Float32Array).slice();
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setIndex(new BufferAttribute(Uint32Array.from(source.getIndex()?.array ?? []), 1));
    const { roots } = MeshBVH.serialize(new MeshBVH(geometry), { cloneBuffers: true });
    const there = new BufferGeometry();
    there.setAttribute('position', new BufferAttribute(positions, 3));
    there.setIndex(new BufferAttribute(Uint32Array.from(geometry.getIndex()?.array ?? []), 1));
    haveBoxes(there, roots);
    const group = new Group();
    group.add(new Mesh(there));
    for (let i = 0; i < 50; ++i) {
      const from = new Vector3(Math.sin(i), Math.cos(i * 1.7), Math.sin(i * 2.3)).normalize().multiplyScalar(50);
      const to = new Vector3(Math.cos(i * 3.1), Math.sin(i * 0.7), Math.cos(i)).multiplyScalar(6);
      const sight = { origin: from, direction: to.clone().sub(from).normalize() };
      const found = pickBone(group, sight, []);
      expect(found).not.toBeNull();
      const place = new Vector3(...(found?.place ?? [0, 0, 0]));
      expect(place.length()).toBeGreaterThan(9.8);
      expect(place.length()).toBeLessThan(10.001);
      // On the line, and on its near side.
      const along = place.clone().sub(from);
      expect(along.clone().cross(sight.direction).length()).toBeLessThan(1e-3);
      expect(along.length()).toBeLessThan(50);
      const corner = new Vector3().fromArray(positions, (found?.corner ?? 0) * 3);
      expect(corner.distanceTo(place)).toBeLessThan(1.7);
    }
  });
});
