// The least that draws a bone's triangles with three.js: one mesh, one material, two lights, one camera that turns.
import {
  BufferAttribute,
  BufferGeometry,
  DirectionalLight,
  HemisphereLight,
  Mesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from 'three';

import type { Turned } from '../turned';
import { bonePicture } from './bone_picture';

export interface BareView {
  widthPx: number;
  heightPx: number;
  targetMm: [number, number, number];
  eyeMm: [number, number, number];
}

export interface BarePage {
  /** What the last picture was drawn with. */
  triangles(): number;
  see(view: BareView): void;
  /** Turns around the vertical, a step and a picture at each of the browser's animation frames. */
  turn(stepRad: number, seconds: number): Promise<Turned>;
}

declare global {
  interface Window {
    bare?: BarePage;
  }
}

async function main(canvas: HTMLCanvasElement): Promise<void> {
  const stream = await (await fetch('./stream')).arrayBuffer();
  const renderer = new WebGLRenderer({ canvas, antialias: true });
  const scene = new Scene();
  const camera = new PerspectiveCamera(32, 1, 1, 2000);
  camera.up.set(0, 0, 1);
  const target = new Vector3();
  const lamp = new DirectionalLight(0xffffff, 2.5);
  scene.add(new HemisphereLight(0xffffff, 0x888888, 1), lamp);

  const { positionsMm, normals, indices } = await bonePicture(stream);
  const bone = new BufferGeometry();
  bone.setAttribute('position', new BufferAttribute(positionsMm, 3));
  bone.setAttribute('normal', new BufferAttribute(normals, 3));
  bone.setIndex(new BufferAttribute(indices, 1));
  scene.add(new Mesh(bone, new MeshStandardMaterial({ color: 0xf2e8d5, roughness: 0.72 })));

  const draw = () => {
    camera.lookAt(target);
    lamp.position.copy(camera.position);
    renderer.render(scene, camera);
  };
  window.bare = {
    triangles: () => renderer.info.render.triangles,
    see({ widthPx, heightPx, targetMm, eyeMm }) {
      renderer.setPixelRatio(window.devicePixelRatio);
      renderer.setSize(widthPx, heightPx);
      camera.aspect = widthPx / heightPx;
      camera.updateProjectionMatrix();
      target.set(...targetMm);
      camera.position.set(...eyeMm);
      draw();
    },
    turn: (stepRad, seconds) =>
      new Promise((turned) => {
        const beganMs = performance.now();
        let pictures = 0;
        const step = () => {
          if (performance.now() - beganMs > seconds * 1000) {
            renderer.getContext().readPixels(0, 0, 1, 1, 0x1908, 0x1401, new Uint8Array(4));
            turned({ pictures, seconds: (performance.now() - beganMs) / 1000 });
            return;
          }
          camera.position.sub(target).applyAxisAngle(camera.up, stepRad).add(target);
          draw();
          ++pictures;
          requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
      }),
  };
}

const canvas = document.querySelector('canvas');
if (canvas !== null) void main(canvas);
