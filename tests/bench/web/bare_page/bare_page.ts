// The least that draws the triangles of a bone and a reamer with three.js: a mesh and a material each, two lights, one camera that turns.
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
import { streamedPicture } from './bone_picture';

/** Of the address, where edges are to be smooth. */
const smoothEdges = '#smooth';

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
  const renderer = new WebGLRenderer({ canvas, antialias: location.hash === smoothEdges });
  const scene = new Scene();
  const camera = new PerspectiveCamera(32, 1, 1, 2000);
  camera.up.set(0, 0, 1);
  const target = new Vector3();
  const lamp = new DirectionalLight(0xffffff, 2.5);
  scene.add(new HemisphereLight(0xffffff, 0x888888, 1), lamp);

  const { bone: picture, reamer } = await streamedPicture(stream);
  const bone = new BufferGeometry();
  bone.setAttribute('position', new BufferAttribute(picture.positionsMm, 3));
  bone.setAttribute('normal', new BufferAttribute(picture.normals, 3));
  bone.setIndex(new BufferAttribute(picture.indices, 1));
  scene.add(new Mesh(bone, new MeshStandardMaterial({ color: 0xf2e8d5, roughness: 0.72 })));
  const tool = new BufferGeometry();
  tool.setAttribute('position', new BufferAttribute(reamer.positionsMm, 3));
  tool.setIndex(new BufferAttribute(reamer.indices, 1));
  tool.computeVertexNormals();
  const toolMesh = new Mesh(tool, new MeshStandardMaterial({ color: 0xb4c0c6, roughness: 0.3 }));
  toolMesh.position.set(...reamer.worldFromTool.translationMm);
  toolMesh.quaternion.set(...reamer.worldFromTool.rotationXyzw);
  scene.add(toolMesh);

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
