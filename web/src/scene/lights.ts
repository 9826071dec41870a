import {
  Color,
  DirectionalLight,
  HemisphereLight,
  type Mesh,
  Vector3,
  type PerspectiveCamera,
  type Scene,
} from 'three';

/** Layer of what is solid: light does not pass. (1 and 2 are the eyes of a headset.) */
export const solidLayer = 3;

/** A light that goes with the viewer. */
interface ViewersLight {
  colour: number;
  intensity: number;
  /** Where it comes from: to the viewer's right, up, and back towards the viewer. */
  from: readonly [right: number, up: number, back: number];
}
const lamp: ViewersLight = { colour: 0xfff6e8, intensity: 2.5, from: [-0.55, 0.9, 1] };
const fill: ViewersLight = { colour: 0xe4edf6, intensity: 0.9, from: [1, -0.1, 0.8] };
const allAround = { above: 0xffffff, below: 0xa39a90, intensity: 0.9 };

/** Of the lamp from what it lights, and the box about that in which it throws shadows, mm. */
const lampMm = 220;
const shadowBox = { left: -110, right: 110, top: 110, bottom: -110, near: 40, far: 420 };
const shadowTexels = 2048;
const shadowBlurTexels = 5;
const shadowBiasMm = 0.35;
/** Lamps of a theatre are wide and stand around the surgeon's head: no shadow is black, and few fall where they look. */
const shadowStrength = 0.47;
const besideWithShadows = 0.5;
/** So much of its light a place keeps in a shadow, if it faces all lights alike. */
export const lightInShadow =
  1 - (shadowStrength * lamp.intensity) / (lamp.intensity + fill.intensity + allAround.intensity);

const directionOf = ({ from }: ViewersLight, right: Vector3, up: Vector3, back: Vector3): Vector3 =>
  new Vector3().addScaledVector(right, from[0]).addScaledVector(up, from[1]).addScaledVector(back, from[2]);

/**
 * Light as in an operating room: a strong lamp over the viewer's left shoulder, raking enough to model a shallow
 * bowl, a weak fill from the right and a little from all around. The lamp goes with the viewer.
 */
export class OperatingLights {
  private readonly lamp = new DirectionalLight(lamp.colour, lamp.intensity);
  private readonly fill = new DirectionalLight(fill.colour, fill.intensity);

  constructor(scene: Scene) {
    const { shadow } = this.lamp;
    shadow.mapSize.setScalar(shadowTexels);
    shadow.radius = shadowBlurTexels;
    shadow.intensity = shadowStrength;
    shadow.normalBias = shadowBiasMm;
    Object.assign(shadow.camera, shadowBox);
    shadow.camera.updateProjectionMatrix();
    const around = new HemisphereLight(allAround.above, allAround.below, allAround.intensity);
    scene.add(around, this.lamp, this.lamp.target, this.fill, this.fill.target);
    // Passes of both layers have the same lights: materials are looked up anew where those differ.
    for (const light of [around, this.lamp, this.fill]) light.layers.enable(solidLayer);
  }

  /** What the shadows fall on lies around this place, world frame. */
  setCentre(centre: Vector3): void {
    for (const light of [this.lamp, this.fill]) light.target.position.copy(centre);
  }

  /** Whether the lamp throws shadows. */
  throwShadows(on: boolean): void {
    if (this.lamp.castShadow === on) return;
    this.lamp.castShadow = on;
    if (on) return;
    this.lamp.shadow.map?.dispose();
    this.lamp.shadow.map = null;
  }

  follow(camera: PerspectiveCamera): void {
    const column = (i: number) => new Vector3().setFromMatrixColumn(camera.matrixWorld, i).normalize();
    const beside = this.lamp.castShadow ? besideWithShadows : 1;
    const [right, up, back] = [column(0).multiplyScalar(beside), column(1).multiplyScalar(beside), column(2)] as const;
    for (const [light, of] of [
      [this.lamp, lamp],
      [this.fill, fill],
    ] as const)
      light.position.copy(light.target.position).addScaledVector(directionOf(of, right, up, back).normalize(), lampMm);
  }
}

/** Throws shadows and is in those of others, wherever the lamp throws any; is solid. */
export function shadowed<T extends Mesh>(mesh: T): T {
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  mesh.layers.enable(solidLayer);
  return mesh;
}

/** What a dull white surface shows to a viewer who stands there, by its normal (unit): for what is lit once and for all. */
export function operatingLightFor(towardsEye: Vector3, viewersUp: Vector3): (normal: Vector3) => Color {
  const right = new Vector3().crossVectors(viewersUp, towardsEye).normalize();
  const up = new Vector3().crossVectors(towardsEye, right);
  const lights = [lamp, fill].map((of) => ({
    colour: new Color(of.colour).multiplyScalar(of.intensity / Math.PI),
    from: directionOf(of, right, up, towardsEye).normalize(),
  }));
  const [below, above] = [allAround.below, allAround.above].map((colour) =>
    new Color(colour).multiplyScalar(allAround.intensity / Math.PI),
  ) as [Color, Color];
  return (normal) => {
    // As three.js has it: its sky is where y is.
    const seen = below.clone().lerp(above, 0.5 + 0.5 * normal.y);
    for (const { colour, from } of lights) seen.add(colour.clone().multiplyScalar(Math.max(0, normal.dot(from))));
    return seen;
  };
}
