import { PerspectiveCamera, Spherical, Vector2, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

import type { Ray } from '../practice/plan_frame';
import type { Hello } from '../wire/messages';
import type { EyePose } from './surgeon_eye';

export type ViewName = 'plan' | 'axis' | 'side';

/** Half the field seen around the glenoid, mm. */
const glenoidFieldMm = 34;
const keyTurnRad = 0.09;
const keyZoom = 1.1;
/** A drag over the height of the picture turns half around. */
const turnRadPerHeight = Math.PI;

/** LPS: z is superior, y posterior. */
export const superior = new Vector3(0, 0, 1);

/** The camera, held on the glenoid: set views along the plan's axis, turned by hand or keys. */
export class OrbitCamera {
  readonly camera = new PerspectiveCamera(32, 1, 1, 2000);
  private readonly controls: OrbitControls;
  private readonly entry = new Vector3();
  private readonly intoBone = new Vector3(-1, 0, 0);
  private fieldRadiusMm = glenoidFieldMm;
  private guided = false;

  /** `onTaken` hears that somebody begins to turn, shift or zoom the view by hand. */
  constructor(
    private readonly surface: HTMLElement,
    onMove: () => void,
    private readonly onInteraction: () => void = () => undefined,
  ) {
    this.camera.up.copy(superior);
    this.controls = new OrbitControls(this.camera, surface);
    this.controls.minDistance = 20;
    this.controls.maxDistance = 800;
    this.controls.addEventListener('change', onMove);
    this.controls.addEventListener('start', onInteraction);
    surface.addEventListener('keydown', (event) => this.onKey(event));
  }

  /** What the set views are held on, and half the field that they show. */
  setPlan(plan: Pick<Hello, 'axisEntryMm' | 'axisDirection'>, fieldRadiusMm = glenoidFieldMm): void {
    this.entry.set(...plan.axisEntryMm);
    this.intoBone.set(...plan.axisDirection).normalize();
    this.fieldRadiusMm = fieldRadiusMm;
  }

  look(view: ViewName): void {
    const towardsViewer = this.intoBone.clone().negate();
    const anterior = new Vector3(0, -1, 0);
    const across = anterior.clone().addScaledVector(towardsViewer, -anterior.dot(towardsViewer)).normalize();
    const from = {
      axis: towardsViewer,
      plan: towardsViewer.clone().multiplyScalar(0.86).addScaledVector(across, 0.5).addScaledVector(superior, 0.3),
      side: across.clone().addScaledVector(superior, 0.08),
    }[view];
    this.controls.target.copy(this.entry);
    this.camera.position.copy(this.entry).addScaledVector(from.normalize(), this.fittingDistance());
    this.controls.update();
  }

  resize(aspect: number): void {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  /** While `guided` pointer and keys are somebody else's, who turns and zooms the view by calls. */
  setGuided(guided: boolean): void {
    this.guided = guided;
    this.controls.enabled = !guided;
  }

  /** The line of sight under a place of the window, world frame. */
  rayAt(clientX: number, clientY: number): Ray {
    const box = this.surface.getBoundingClientRect();
    const onPicture = new Vector2(
      ((clientX - box.left) / box.width) * 2 - 1,
      1 - ((clientY - box.top) / box.height) * 2,
    );
    this.camera.updateMatrixWorld();
    const origin = this.camera.position.clone();
    const direction = new Vector3(onPicture.x, onPicture.y, 0.5).unproject(this.camera).sub(origin).normalize();
    return { origin, direction };
  }

  /** To the right and up on the picture, world frame, units. */
  screenDirections(): { right: Vector3; up: Vector3 } {
    this.camera.updateMatrixWorld();
    const column = (i: number) => new Vector3().setFromMatrixColumn(this.camera.matrixWorld, i);
    return { right: column(0), up: column(1) };
  }

  /** From where the picture is seen, with `up` upwards on it. */
  eyePose(up: Vector3): EyePose {
    const { target } = this.controls;
    return { target: target.clone(), towardsEye: this.camera.position.clone().sub(target).normalize(), up };
  }

  get distanceMm(): number {
    return this.camera.position.distanceTo(this.controls.target);
  }

  /** Seen from there until it is turned by hand, which turns upright again. */
  setEyePose({ target, towardsEye, up }: EyePose, distanceMm: number): void {
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(towardsEye, distanceMm);
    this.camera.up.copy(up);
    this.camera.lookAt(target);
    this.camera.up.copy(superior);
  }

  turnBy(rightPx: number, downPx: number): void {
    this.onInteraction();
    const radPerPx = turnRadPerHeight / Math.max(this.surface.clientHeight, 1);
    this.turn(-rightPx * radPerPx, -downPx * radPerPx);
  }

  /** More than 1: away. */
  zoom(factor: number): void {
    this.onInteraction();
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
  }

  /** From here the field, or one of another radius, fits the narrower side of the picture. */
  fittingDistance(fieldRadiusMm = this.fieldRadiusMm): number {
    const halfVertical = (this.camera.fov * Math.PI) / 360;
    const halfHorizontal = Math.atan(Math.tan(halfVertical) * this.camera.aspect);
    return fieldRadiusMm / Math.sin(Math.min(halfVertical, halfHorizontal));
  }

  private onKey(event: KeyboardEvent): void {
    if (this.guided) return;
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (step !== undefined) {
      this.onInteraction();
      this.turn((step[0] ?? 0) * keyTurnRad, (step[1] ?? 0) * keyTurnRad);
    } else if (event.key === '+' || event.key === '=') this.zoom(1 / keyZoom);
    else if (event.key === '-') this.zoom(keyZoom);
    else if (event.key === 'Home') {
      this.onInteraction();
      this.look('plan');
    } else return;
    event.preventDefault();
  }

  /** Turns around the vertical and towards the pole, radians. */
  private turn(around: number, polar: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    // Spherical's pole is y; the world's is z.
    const spherical = new Spherical().setFromCartesianCoords(offset.x, offset.z, -offset.y);
    spherical.theta += around;
    spherical.phi += polar;
    spherical.makeSafe();
    const turned = new Vector3().setFromSpherical(spherical);
    this.camera.position.copy(this.controls.target).add(new Vector3(turned.x, -turned.z, turned.y));
    this.controls.update();
  }
}
