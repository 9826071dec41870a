import { effect, type ReadonlySignal, signal } from '@preact/signals';
import {
  BufferGeometry,
  Group,
  Line,
  LineBasicMaterial,
  LineLoop,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  NeutralToneMapping,
  Raycaster,
  Scene,
  SphereGeometry,
  Vector3,
  WebGLRenderer,
} from 'three';

import { planeNames } from '../ct/orientation';
import { add, subtract } from '../ct/volume_frame';
import type { CaseController } from '../state/case/case_controller';
import type { PlanMark, PointMark, ViewMarks } from '../state/case/view_marks';
import { messageOf } from '../wire/rest';
import type { Triple } from '../wire/rest_types';
import { MeshLoader } from '../wire/mesh_loader';
import type { Surface } from '../wire/ply';
import { OrbitCamera } from './orbit_camera';
import { type ContextWatch, watchContext } from './context_watch';
import { wholeBoneColour } from './cut_bone';
import { FrameRequest } from './frame_request';
import { OperatingLights } from './lights';
import { planMeshes } from './plan_meshes';
import { surfaceGeometry } from './surface_geometry';
import { planeColours } from './slice_view';

const pixelRatioMax = 2;
const clickWithinPx = 4;
const crossHairArmMm = 8;
const crossHairArms: readonly Triple[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];
const restsAfterMs = 60;
const drawAtLeastEveryMs = 400;
const pointRadiusMm = 1.4;
/** The slices' outlines are this much larger than the bone. */
const planeMarginMm = 8;

/** A placed point as it is on the picture, for its label. */
export interface PointLabel {
  x: number;
  y: number;
  text: string;
  active: boolean;
}

/** The bone's surface with cross-hair, slice planes, landmarks and plan. Draws only when something changed. */
export class SurfaceView {
  readonly canvas = document.createElement('canvas');
  readonly labels = signal<readonly PointLabel[]>([]);
  /** Time of the last look for the surface under a click, ms. */
  lastPickMs = 0;

  private readonly context: ContextWatch;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly lights: OperatingLights;
  private readonly orbit: OrbitCamera;
  private readonly loader = new MeshLoader();
  private readonly boneMaterial = new MeshStandardMaterial({ color: wholeBoneColour, roughness: 0.72, metalness: 0 });
  private bone: Mesh | null = null;
  private surface: Surface | null = null;
  /** Of which state of the case the surface was asked for. */
  private loadedOf = '';
  private readonly crossHair = new Group();
  private readonly points = new Group();
  private plan: Group | null = null;
  private held: PointMark | null = null;
  private readonly drawing = new FrameRequest(() => this.draw());
  private drawnAtMs = 0;
  private readonly stops: (() => void)[] = [];

  /** Throws where the browser offers no WebGL. */
  constructor(
    private readonly controller: CaseController,
    private readonly marks: ViewMarks,
  ) {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1.05;
    this.context = watchContext(this.canvas, () => this.resize());
    this.canvas.tabIndex = 0;
    this.listenForClicks();
    this.orbit = new OrbitCamera(this.canvas, () => this.invalidate());
    this.lights = new OperatingLights(this.scene);
    this.scene.add(this.crossHair, this.points);
    const resizes = new ResizeObserver(() => this.resize());
    resizes.observe(this.canvas);
    this.stops.push(
      () => this.context.dispose(),
      () => resizes.disconnect(),
      effect(() => this.followSurface()),
      effect(() => this.showCrossHair()),
      effect(() => this.showPoints(this.marks.points.value)),
      effect(() => this.showPlan(this.marks.plan.value)),
    );
  }

  /** The browser has taken the picture away; it is drawn anew when it is given back. */
  get lost(): ReadonlySignal<boolean> {
    return this.context.lost;
  }

  get triangleCount(): number {
    return (this.surface?.indices.length ?? 0) / 3;
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    this.drawing.dispose();
    this.loader.dispose();
    this.bone?.geometry.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** From the patient's side, front, or close to the glenoid along the axis of the plan. */
  look(view: 'side' | 'front' | 'glenoid'): void {
    const glenoid = this.glenoid();
    if (view === 'glenoid' && glenoid !== null) {
      this.orbit.setPlan(glenoid);
      this.orbit.look('plan');
    } else if (this.surface !== null) {
      const { low, high } = this.surface;
      const centre = add(low, high).map((value) => value / 2) as Triple;
      const radius = Math.hypot(...subtract(high, low)) / 2;
      this.orbit.setPlan({ axisEntryMm: centre, axisDirection: this.medial() }, Math.max(radius, 10));
      this.orbit.look(view === 'front' ? 'side' : 'axis');
    }
    this.invalidate();
  }

  /** Where the views that go close to the glenoid look, or null while it is not known. */
  glenoid(): { axisEntryMm: Triple; axisDirection: Triple } | null {
    const plan = this.controller.store.draft.value?.plan;
    if (plan !== undefined) return { axisEntryMm: plan.entry_mm, axisDirection: plan.axis_direction };
    const { glenoid_centre_mm: centre, trigonum_mm: root } = this.controller.landmarks.landmarks.value;
    if (centre === undefined) return null;
    return { axisEntryMm: centre, axisDirection: root === undefined ? this.medial() : subtract(root, centre) };
  }

  private medial(): Triple {
    return this.controller.store.details.value?.side === 'left' ? [-1, 0, 0] : [1, 0, 0];
  }

  /** Loads the surface whenever the server has another one. */
  private followSurface(): void {
    const details = this.controller.store.details.value;
    const of = [details?.stage, details?.segmentation?.revision, details?.built?.segmentation_revision].join();
    if (details === null || of === this.loadedOf) return;
    this.loadedOf = of;
    if (details.stage === 'ct') {
      this.show(null);
      this.controller.store.surface.value = { kind: 'none' };
    } else void this.load();
  }

  private async load(): Promise<void> {
    const { store } = this.controller;
    store.surface.value = { kind: 'loading' };
    try {
      const surface = await this.loader.load(this.controller.meshUrl());
      if (surface === null) return;
      this.show(surface);
      store.surface.value = { kind: 'shown' };
    } catch (error) {
      store.surface.value = { kind: 'failed', message: messageOf(error) };
    }
  }

  private show(surface: Surface | null): void {
    const first = this.surface === null;
    if (this.bone !== null) {
      this.scene.remove(this.bone);
      this.bone.geometry.dispose();
      this.bone = null;
    }
    this.surface = surface;
    if (surface !== null) {
      this.bone = new Mesh(surfaceGeometry(surface), this.boneMaterial);
      this.scene.add(this.bone);
      if (first) this.look('side');
    }
    this.showCrossHair();
    this.invalidate();
  }

  private showCrossHair(): void {
    const { frame, crossHair, planes } = this.controller.store;
    empty(this.crossHair);
    if (frame.value !== null && planes.value !== null) {
      const middle = frame.value.worldFromVoxel(crossHair.value);
      for (const direction of crossHairArms) {
        const ends = [-crossHairArmMm, crossHairArmMm].map((mm) => new Vector3(...add(middle, direction, mm)));
        this.crossHair.add(onTop(new Line(new BufferGeometry().setFromPoints(ends), lineMaterial('#d6336c'))));
      }
      const { surface } = this;
      const { low, high } =
        surface === null
          ? { low: [0, 0, 0] as Triple, high: frame.value.dims }
          : frame.value.voxelBox(surface.low, surface.high, planeMarginMm);
      for (const name of planeNames) {
        const corners = frame.value.sliceCorners(planes.value[name].axis, crossHair.value, low, high);
        const outline = new BufferGeometry().setFromPoints(corners.map((corner) => new Vector3(...corner)));
        this.crossHair.add(new LineLoop(outline, lineMaterial(planeColours[name])));
      }
    }
    this.invalidateSoon();
  }

  private showPoints(marks: readonly PointMark[]): void {
    empty(this.points);
    for (const { point, active, of } of marks) {
      const colour = of.kind === 'entry' ? 0x0b8f6a : active ? 0xff6a00 : 0xd9940a;
      const radius = active ? pointRadiusMm * 1.25 : pointRadiusMm;
      const ball = new Mesh(new SphereGeometry(radius, 20, 14), new MeshBasicMaterial({ color: colour }));
      ball.position.set(...point);
      this.points.add(ball);
    }
    this.invalidate();
  }

  private showPlan(plan: PlanMark | null): void {
    if (this.plan !== null) {
      empty(this.plan);
      this.scene.remove(this.plan);
    }
    this.plan = plan === null ? null : planMeshes(plan);
    if (this.plan !== null) this.scene.add(this.plan);
    this.invalidate();
  }

  private listenForClicks(): void {
    let start: { x: number; y: number } | null = null;
    this.canvas.addEventListener(
      'pointerdown',
      (event) => {
        this.canvas.focus({ preventScroll: true });
        if (event.button !== 0) return;
        start = { x: event.clientX, y: event.clientY };
        this.held = this.markUnder(event);
        if (this.held === null) return;
        // The point is moved, not the view.
        this.orbit.setGuided(true);
        this.canvas.setPointerCapture(event.pointerId);
      },
      { capture: true },
    );
    this.canvas.addEventListener('pointermove', (event) => {
      if (this.held === null || start === null || isNear(event, start)) return;
      const point = this.pick(event);
      if (point === null) return;
      this.controller.chooseMark(this.held.of);
      this.marks.move(this.held, point);
    });
    this.canvas.addEventListener('pointerup', (event) => {
      const held = this.held;
      this.held = null;
      this.orbit.setGuided(false);
      const still = start !== null && isNear(event, start);
      start = null;
      if (!still || event.button !== 0) return;
      if (held !== null && !this.controller.placesNew()) this.controller.chooseMark(held.of);
      else this.click(event);
    });
    this.canvas.addEventListener('pointercancel', () => {
      this.held = null;
      this.orbit.setGuided(false);
    });
  }

  private click(event: MouseEvent): void {
    const point = this.pick(event);
    if (point === null) return;
    const { store } = this.controller;
    this.controller.lookAt(point);
    if (store.openStep.value === 'landmarks' || store.openStep.value === 'segment') this.controller.placeArmed(point);
  }

  /** The surface under a place of the window. */
  private pick(event: MouseEvent): Triple | null {
    if (this.bone === null) return null;
    const before = performance.now();
    const { origin, direction } = this.orbit.rayAt(event.clientX, event.clientY);
    const hit = new Raycaster(origin, direction).intersectObject(this.bone, false)[0];
    this.lastPickMs = performance.now() - before;
    return hit === undefined ? null : hit.point.toArray();
  }

  private markUnder(event: MouseEvent): PointMark | null {
    const box = this.canvas.getBoundingClientRect();
    const at = { x: event.clientX - box.left, y: event.clientY - box.top };
    const marks = this.marks.points.value;
    const isUnder = (i: number) => {
      const label = this.labels.value[i];
      return label !== undefined && Math.hypot(label.x - at.x, label.y - at.y) < 11;
    };
    return marks.find((mark, i) => isUnder(i) && this.marks.draggable(mark)) ?? null;
  }

  /** Once the cross-hair rests, or now and then while it moves: slices go before the surface. */
  private invalidateSoon(): void {
    if (performance.now() - this.drawnAtMs > drawAtLeastEveryMs) this.invalidate();
    else this.drawing.requestAfter(restsAfterMs);
  }

  private invalidate(): void {
    this.drawing.request();
  }

  private draw(): void {
    if (this.lost.value) return;
    const { camera } = this.orbit;
    camera.updateMatrixWorld();
    this.lights.follow(camera);
    this.renderer.render(this.scene, camera);
    this.drawnAtMs = performance.now();
    const { clientWidth, clientHeight } = this.canvas;
    this.labels.value = this.marks.points.value.map(({ point, text, active }) => {
      const onScreen = new Vector3(...point).project(camera);
      const x = ((onScreen.x + 1) / 2) * clientWidth;
      const y = ((1 - onScreen.y) / 2) * clientHeight;
      return { x, y, text, active };
    });
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, pixelRatioMax));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.orbit.resize(clientWidth / clientHeight);
    this.draw();
  }
}

const isNear = (event: MouseEvent, { x, y }: { x: number; y: number }) =>
  Math.hypot(event.clientX - x, event.clientY - y) <= clickWithinPx;

const lineMaterial = (color: string) => new LineBasicMaterial({ color });

/** Drawn over the bone, which would hide it. */
function onTop<T extends Line>(shape: T): T {
  (shape.material as LineBasicMaterial).depthTest = false;
  shape.renderOrder = 2;
  return shape;
}

function empty(group: Group): void {
  for (const part of [...group.children]) {
    group.remove(part);
    (part as Mesh).geometry.dispose();
    ((part as Mesh).material as MeshBasicMaterial).dispose();
  }
}
