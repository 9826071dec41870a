import { InstancedMesh, Mesh, type MeshStandardMaterial, type Object3D } from 'three';
import { describe, expect, it } from 'vitest';

import { ToolView } from '../../src/scene/tool_view';
import type { ToolAction } from '../../src/state/tool_action';
import type { Pose } from '../../src/wire/messages';
import { libraryOutlines, revolved } from './library_tools';

const pose: Pose = { rotationXyzw: [0, 0, 0, 1], translationMm: [1, 2, 3] };
const reaming = (tick: number, changes: Partial<ToolAction> = {}): ToolAction => ({
  spindleRadS: 8,
  irrigating: false,
  removedMm3: tick / 20,
  tick,
  ...changes,
});

function shown(full: boolean, still = false, name = 'convex-30') {
  const view = new ToolView({ matches: still });
  view.setMesh(revolved(libraryOutlines[name] ?? []));
  view.setPose(pose);
  view.setLook('glass', full, true);
  return view;
}

/** What is drawn. */
function meshes(view: ToolView): Mesh[] {
  const found: Mesh[] = [];
  view.group.traverseVisible((part: Object3D) => {
    if (part instanceof Mesh) found.push(part as Mesh);
  });
  return found;
}
const opacities = (view: ToolView) => meshes(view).map(({ material }) => (material as MeshStandardMaterial).opacity);
const chips = (view: ToolView) => meshes(view).find((mesh) => mesh instanceof InstancedMesh);

/** Reams through some pictures; whether the last one asks for another. */
function ream(view: ToolView, changes: Partial<ToolAction> = {}): boolean {
  let more = false;
  for (let tick = 1000; tick < 2000; tick += 16) {
    view.setAction(reaming(tick, changes));
    more = view.step(0.016);
  }
  return more;
}

describe('ToolView', () => {
  it('is a glass envelope and a shaft where it is plain, and rests whatever it does', () => {
    const view = shown(false);
    expect(opacities(view)).toEqual([0.5, 1]);
    expect(ream(view)).toBe(false);
    expect(opacities(view)).toEqual([0.5, 1]);
  });

  it('is plain where the mesh is no body of revolution', () => {
    const view = new ToolView({ matches: false });
    view.setMesh(revolved(libraryOutlines['convex-30'] ?? [], 6));
    view.setPose(pose);
    view.setLook('glass', true, true);
    expect(opacities(view)).toEqual([0.5, 1]);
    expect(ream(view)).toBe(false);
  });

  it('is not drawn before its pose is known, nor where it is not wanted', () => {
    const view = shown(true);
    view.setShown(false);
    expect(meshes(view)).toEqual([]);
    expect(ream(view)).toBe(false);
    view.setShown(true);
    view.setMesh(revolved(libraryOutlines['flat-30'] ?? []));
    expect(meshes(view)).toEqual([]);
  });

  it('turns and throws chips while it reams, and rests with its session', () => {
    const view = shown(true);
    expect(view.step(0.016)).toBe(false);
    expect(ream(view)).toBe(true);
    expect(chips(view)).toBeDefined();
    view.setAction(null);
    expect(view.step(0.016)).toBe(false);
    expect(chips(view)).toBeUndefined();
  });

  it('lets the last chips fall when the spindle stands, and then rests', () => {
    const view = shown(true);
    ream(view);
    view.setAction(reaming(2016, { spindleRadS: 0, removedMm3: 99 }));
    let pictures = 0;
    while (view.step(0.016) && pictures < 500) ++pictures;
    expect(pictures).toBeGreaterThan(10);
    expect(pictures).toBeLessThan(100);
  });

  it('neither turns nor throws anything where people want no motion', () => {
    const view = shown(true, true);
    expect(ream(view, { irrigating: true })).toBe(false);
    expect(chips(view)).toBeUndefined();
  });

  it('shows no chips where bone is cut away or seen through', () => {
    for (const [look, whole] of [
      ['glass', false],
      ['throughBone', true],
    ] as const) {
      const view = shown(true);
      view.setLook(look, true, whole);
      ream(view);
      expect(chips(view)).toBeUndefined();
    }
  });

  it('is opaque steel in theatre, without an envelope around it', () => {
    const view = shown(true);
    view.setLook('steel', true, true);
    expect(opacities(view)).toEqual([1, 1]);
    const plain = shown(false);
    plain.setLook('steel', false, true);
    expect(opacities(plain)).toEqual([1, 1]);
  });

  it('becomes plain again, and full', () => {
    const view = shown(true);
    const full = meshes(view).length;
    ream(view);
    view.setLook('glass', false, true);
    expect(opacities(view)).toEqual([0.5, 1]);
    view.setLook('glass', true, true);
    expect(meshes(view)).toHaveLength(full);
  });
});
