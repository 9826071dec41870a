import { SphereGeometry } from 'three';
import { describe, expect, it } from 'vitest';

import { faceHeights } from '../../src/scene/face_heights';
import type { ToolMesh } from '../../src/wire/messages';

/** A cap of a sphere with its apex at the origin, opening towards -z. */
function cap(radiusMm: number, rimMm: number): ToolMesh {
  const geometry = new SphereGeometry(radiusMm, 96, 48, 0, 2 * Math.PI, 0, Math.asin(rimMm / radiusMm));
  geometry.rotateX(Math.PI / 2).translate(0, 0, -radiusMm);
  return {
    name: 'cap',
    positionsMm: Float32Array.from(geometry.getAttribute('position').array),
    indices: Uint32Array.from(geometry.getIndex()?.array ?? []),
  };
}

describe('faceHeights', () => {
  it('follows the face of a spherical reamer', () => {
    const { reachMm, heightsMm } = faceHeights(cap(25, 18), 19);
    expect(reachMm).toBeCloseTo(18, 3);
    heightsMm.forEach((height, i) => {
      const off = (i * reachMm) / 18;
      expect(Math.abs(height - (Math.sqrt(25 * 25 - off * off) - 25))).toBeLessThan(0.02);
    });
  });

  it('says nothing of no reamer', () => {
    const { reachMm } = faceHeights({ name: '', positionsMm: new Float32Array(), indices: new Uint32Array() }, 8);
    expect(reachMm).toBe(0);
  });
});
