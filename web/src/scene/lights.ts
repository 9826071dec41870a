import { DirectionalLight, HemisphereLight, Vector3, type PerspectiveCamera, type Scene } from 'three';

/**
 * Light as in an operating room: a strong lamp over the viewer's left shoulder, raking enough to model a shallow
 * bowl, a weak fill from the right and a little from all around. The lamp goes with the viewer.
 */
export class OperatingLights {
  private readonly lamp = new DirectionalLight(0xfff6e8, 2.5);
  private readonly fill = new DirectionalLight(0xdbe8f5, 0.55);

  constructor(scene: Scene) {
    scene.add(new HemisphereLight(0xffffff, 0x8a7f74, 0.75), this.lamp, this.lamp.target, this.fill, this.fill.target);
  }

  follow(camera: PerspectiveCamera): void {
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
    const back = new Vector3().setFromMatrixColumn(camera.matrixWorld, 2);
    this.lamp.position.copy(right).multiplyScalar(-0.9).addScaledVector(up, 0.95).addScaledVector(back, 0.85);
    this.fill.position.copy(right).addScaledVector(up, -0.25).addScaledVector(back, 0.8);
  }
}
