import { DirectionalLight, HemisphereLight, Vector3, type PerspectiveCamera, type Scene } from 'three';

/**
 * Light as in an operating room: a strong lamp over the viewer's left shoulder, raking enough to model a shallow
 * bowl, a weak fill from the right and a little from all around. The lamp goes with the viewer.
 */
export class OperatingLights {
  private readonly lamp = new DirectionalLight(0xfff6e8, 2.5);
  private readonly fill = new DirectionalLight(0xe4edf6, 0.9);

  constructor(scene: Scene) {
    scene.add(new HemisphereLight(0xffffff, 0xa39a90, 0.9), this.lamp, this.lamp.target, this.fill, this.fill.target);
  }

  follow(camera: PerspectiveCamera): void {
    const column = (i: number) => new Vector3().setFromMatrixColumn(camera.matrixWorld, i).normalize();
    const [right, up, back] = [column(0), column(1), column(2)] as const;
    this.lamp.position.copy(right).multiplyScalar(-0.55).addScaledVector(up, 0.9).addScaledVector(back, 1);
    this.fill.position.copy(right).addScaledVector(up, -0.1).addScaledVector(back, 0.8);
  }
}
