import type { ReadonlySignal } from '@preact/signals';
import {
  Group,
  MeshBasicMaterial,
  NeutralToneMapping,
  type PerspectiveCamera,
  type Plane,
  Quaternion,
  Scene,
  Vector3,
  WebGLRenderer,
} from 'three';

import type { ScreenAxes } from '../practice/gamepad_hand';
import { type Beside, PlanFrame, type Ray } from '../practice/plan_frame';
import type { SteeredView } from '../practice/pointer_hand';
import type { ToolAction } from '../state/tool_action';
import { plainView, type ViewChoices } from '../state/view_settings';
import { type BlockSurface, type Hello, isTwoPlates, type MeshDelta, type Pose, type ToolMesh } from '../wire/messages';
import type { Surface } from '../wire/ply';
import { AimView } from './aim_view';
import { AmbientOcclusion } from './ambient_occlusion';
import { BoneView, type BoneReplacement } from './bone_view';
import { MovingParts } from './moving_parts';
import { OrbitCamera, type ViewName } from './orbit_camera';
import { PictureQuality } from './picture_quality';
import { watchContext } from './context_watch';
import { planeThroughAxis, sectionPlanes } from './cut_planes';
import { OperativeField, theatreViewMm } from './operative_field';
import { FrameRequest } from './frame_request';
import { Headset, type Standpoint } from './headset';
import { OperatingLights } from './lights';
import type { Eye } from './shared_eye';
import { drawsInSoftware } from './software_drawing';
import { SurgeonCamera } from './surgeon_camera';
import { SurroundingsView } from './surroundings_view';
import { ToolView } from './tool_view';

/** Beyond this the eye gains little and a tablet loses much. */
const pixelRatioMax = 2;
/** Where triangles are dear, a picture that comes is not drawn as it grows unless it takes so long, ms; */
const growsUnseenMs = 500;
/** and once it is whole, seldom before it is of fewer triangles, unless that takes so long, ms. */
const seldomEveryMs = 250;
const simplerWithinMs = 5000;
/** A picture that was not drawn for a while does not make up for it in one step. */
const longestStepS = 0.1;

/** The three-dimensional picture. Draws only when something changed. */
export class BoneScene implements SteeredView {
  readonly canvas = document.createElement('canvas');
  /** What others draw beside the bone, in the frame of the bone at rest; seen wherever the reamer is. */
  readonly extras = new Group();
  /** The browser has taken the picture away; it is drawn anew when it is given back. */
  readonly lost: ReadonlySignal<boolean>;
  readonly headset: Headset;
  readonly quality: PictureQuality;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly bone = new BoneView(() => this.invalidate());
  private readonly surroundings = new SurroundingsView();
  private readonly field = new OperativeField();
  private readonly tool = new ToolView(window.matchMedia('(prefers-reduced-motion: reduce)'));
  private toolMoves = false;
  private readonly parts = new MovingParts();
  /** Whether pictures are drawn by the computer's processor, by the triangle. */
  readonly inSoftware = drawsInSoftware();
  private readonly aim = new AimView();
  private readonly lights: OperatingLights;
  private readonly occlusion = new AmbientOcclusion();
  private readonly orbit: OrbitCamera;
  private readonly surgeon: SurgeonCamera;
  /** Makes what lies behind the nearest bone unseen where the bone is seen through. */
  private readonly depthOnly = new MeshBasicMaterial({ colorWrite: false });
  private choices: ViewChoices = plainView;
  private inTheatre = false;
  private plan: PlanFrame | null = null;
  private toolPose: Pose | null = null;
  private framedCase: string | null = null;
  private readonly drawing = new FrameRequest(() => {
    if (this.canvas.isConnected) this.draw();
  });
  /** Clock of the page. */
  private simplerDueUntilMs = 0;
  private drawn = 0;
  private drawnAtMs = 0;
  /** Hears of every picture that was drawn. */
  onDrawn: () => void = () => undefined;
  /** Hears that somebody begins to turn or zoom the picture by hand. */
  onInteraction: () => void = () => undefined;

  /** Throws where the browser offers no WebGL. */
  constructor() {
    this.quality = new PictureQuality(this.inSoftware);
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: !this.inSoftware, alpha: true });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1.05;
    this.renderer.localClippingEnabled = true;
    this.renderer.shadowMap.enabled = true;
    this.orbit = new OrbitCamera(
      this.canvas,
      () => this.invalidate(),
      () => {
        this.surgeon.taken();
        this.onInteraction();
      },
    );
    this.surgeon = new SurgeonCamera(this.orbit);
    this.lights = new OperatingLights(this.scene);
    for (const material of [this.bone.paint.material, this.surroundings.material]) this.occlusion.darken(material);
    this.headset = new Headset(
      this.renderer,
      () => this.draw(),
      () => this.resize(),
    );
    this.extras.add(this.surroundings.group, this.field.group);
    this.scene.add(this.bone.group, this.tool.group, this.aim.group, this.extras, this.headset.room);
    // After the renderer's own listeners, which make what is drawn with anew.
    this.lost = watchContext(this.canvas, () => this.resize()).lost;
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  get framesDrawn(): number {
    return this.drawn;
  }
  /** Something has changed since the last picture. */
  get waitsToDraw(): boolean {
    return this.drawing.isWaiting;
  }
  /** The whole bone is there, and is soon of fewer triangles. */
  get simplerDue(): boolean {
    return performance.now() < this.simplerDueUntilMs;
  }
  get blockCount(): number {
    return this.bone.blockCount;
  }
  get triangleCount(): number {
    return this.renderer.info.render.triangles;
  }
  /** Null before the first hello. */
  get planFrame(): PlanFrame | null {
    return this.plan;
  }
  /** All that is seen of the bone; what lies on the negative side of any of `cuts` (world frame) is not. */
  get seenBone(): { group: Group; cuts: Plane[] } {
    return { group: this.bone.group, cuts: this.cuts(this.orbit.camera) };
  }

  dispose(): void {
    this.drawing.dispose();
    this.headset.dispose();
    this.bone.dispose();
    this.surroundings.dispose();
    this.occlusion.dispose();
    this.field.dispose();
    this.tool.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** What lies around the bone, frame of the bone at rest; null: nothing. */
  showSurroundings(surface: Surface | null): void {
    this.surroundings.show(surface);
    this.invalidate();
  }

  /** Something else in the bone's place; null: the bone again. */
  replaceBone(other: BoneReplacement | null): void {
    this.bone.replaceBone(other);
    this.invalidate();
  }

  /** At a person's click; what is seen begins from where the picture is seen. */
  enterHeadset(): void {
    void this.headset.putOn(() => this.standpoint());
  }
  private standpoint(): Standpoint {
    const { target, towardsEye } = this.eye();
    return { target, eye: target.clone().add(towardsEye) };
  }

  /** From where the picture is seen. */
  eye(): Eye {
    return { ...this.orbit.eyePose(this.orbit.screenDirections().up), distanceMm: this.orbit.distanceMm };
  }
  setEye(eye: Eye): void {
    this.surgeon.taken();
    this.orbit.setEyePose(eye, eye.distanceMm);
    this.invalidate();
  }

  /** A new connection's picture begins. The view stays as the viewer left it unless the case is another. */
  begin(hello: Hello): void {
    this.bone.begin(hello);
    this.simplerDueUntilMs = 0;
    if (this.inSoftware) this.drawing.hold(growsUnseenMs);
    this.parts.forget();
    this.setTool(hello.tool);
    this.orbit.setPlan(hello);
    this.plan = new PlanFrame(hello);
    this.surgeon.setPlan(this.plan);
    this.surroundings.begin(hello);
    this.lights.setCentre(this.plan.entry);
    this.field.setPlan(isTwoPlates(hello) ? null : this.plan);
    if (this.framedCase !== hello.caseId) {
      this.framedCase = hello.caseId;
      this.orbit.look('plan');
      this.surgeon.framed();
      // Who wears the headset already was placed before nothing, or before another bone.
      this.headset.place(this.standpoint());
    }
    this.invalidate();
  }

  apply(mesh: MeshDelta): void {
    this.bone.apply(mesh);
    if (mesh.keyComplete) this.drawing.release();
    if (mesh.simplerFollow === true) this.simplerDueUntilMs = performance.now() + simplerWithinMs;
    this.invalidate();
  }

  simplify(blocks: readonly BlockSurface[]): void {
    this.bone.simplify(blocks);
    this.simplerDueUntilMs = 0;
    this.drawing.release();
    this.invalidate();
  }

  /** Another reamer from here on; drawn once its pose is known. */
  setTool(tool: ToolMesh): void {
    this.parts.forget();
    this.tool.setMesh(tool);
    this.bone.paint.setTool(tool);
    this.invalidate();
  }

  setToolPose(pose: Pose | null): void {
    if (!this.parts.toolMoved(pose)) return;
    this.toolPose = pose;
    this.tool.setPose(pose);
    this.bone.paint.setToolPose(pose);
    this.surgeon.setTool(pose === null ? null : new Vector3(...pose.translationMm));
    this.invalidate();
  }

  /** Tool and bone come with the same message, so that they are drawn as they were at one moment. */
  setBonePose(worldFromBoneRest: Pose | null): void {
    if (!this.parts.boneMoved(worldFromBoneRest)) return;
    this.bone.setPose(worldFromBoneRest);
    this.extras.position.copy(this.bone.group.position);
    this.extras.quaternion.copy(this.bone.group.quaternion);
    this.invalidate();
  }

  /** Whether the reamer presses on bone now. */
  setTouching(touching: boolean): void {
    if (!this.parts.touchingChanged(touching)) return;
    this.bone.paint.setTouching(touching);
    this.invalidate();
  }

  /** What the reamer does; null: it rests. */
  setToolAction(action: ToolAction | null): void {
    this.tool.setAction(action);
    // Water runs on where nothing else changes.
    if (this.parts.actionChanged(action) || action?.irrigating === true) this.invalidate();
  }

  setToolShown(shown: boolean): void {
    this.tool.setShown(shown);
    this.invalidate();
  }

  /** What of the bone is seen and from where. In theatre the reamer hides what is behind it, and no plan is drawn. */
  setView(choices: ViewChoices, theatre: boolean): void {
    this.choices = choices;
    this.quality.choose(choices.toolDrawing);
    this.inTheatre = theatre;
    this.aim.setWanted(!theatre);
    this.bone.paint.setWanted(choices.boneKinds);
    this.surgeon.follow(choices.camera === 'trainee', theatre ? theatreViewMm : undefined);
    this.invalidate();
  }

  /** Where the hand aims beside the plan; null: nobody steers here, and the picture is turned by pointer and keys. */
  setAim(plan: PlanFrame | null, place: Beside): void {
    this.orbit.setGuided(plan !== null);
    this.aim.set(plan, place);
    this.invalidate();
  }

  rayAt(clientX: number, clientY: number): Ray {
    return this.orbit.rayAt(clientX, clientY);
  }

  screenAxes(plan: PlanFrame): ScreenAxes {
    const { right, up } = this.orbit.screenDirections();
    return { right: plan.beside(right), up: plan.beside(up) };
  }

  turnBy(rightPx: number, downPx: number): void {
    this.orbit.turnBy(rightPx, downPx);
    this.invalidate();
  }

  zoomBy(factor: number): void {
    this.orbit.zoom(factor);
    this.invalidate();
  }

  look(view: ViewName): void {
    this.surgeon.taken();
    this.orbit.look(view);
    this.invalidate();
  }

  /** What nobody sees is not drawn; resize() draws it when it is shown again. */
  invalidate(): void {
    if (this.canvas.isConnected && !this.headset.worn.peek()) this.drawing.request();
  }

  private draw(): void {
    if (this.lost.value) return;
    const beganMs = performance.now();
    const worn = this.headset.worn.peek();
    const camera = worn ? this.headset.camera : this.orbit.camera;
    const seconds = Math.min((beganMs - this.drawnAtMs) / 1000, longestStepS);
    const moving = this.surgeon.step(seconds);
    if (this.toolMoves) this.quality.drawnAfter(beganMs - this.drawnAtMs);
    this.drawnAtMs = beganMs;
    if (!worn) camera.updateMatrixWorld();
    const seenThrough = this.choices.seeThrough && this.choices.opacity < 1;
    const fine = this.quality.level.peek() === 'fine' && !seenThrough && !worn;
    this.lights.throwShadows(fine);
    this.lights.follow(camera);
    const cuts = this.cuts(camera);
    this.bone.paint.setPores(this.quality.full.peek());
    this.bone.setLook(seenThrough ? this.choices.opacity : 1, cuts);
    this.surroundings.setLook(seenThrough, cuts);
    this.field.setShown(this.inTheatre, this.quality.full.peek());
    const look = this.inTheatre ? 'steel' : seenThrough ? 'throughBone' : 'glass';
    this.tool.setLook(look, this.quality.full.peek(), cuts.length === 0);
    this.toolMoves = this.tool.step(seconds);
    this.occlusion.prepare(fine, this.renderer, this.scene, camera, cuts);
    if (seenThrough) this.drawSeenThrough(cuts, camera);
    else this.renderer.render(this.scene, camera);
    ++this.drawn;
    this.onDrawn();
    if ((moving || this.toolMoves) && !worn) this.invalidate();
    if (this.simplerDue) this.drawing.hold(seldomEveryMs);
  }

  /** Through the nearest bone the reamer is seen, but none of the bone behind. */
  private drawSeenThrough(cuts: Plane[], camera: PerspectiveCamera): void {
    const { renderer, scene } = this;
    const showAim = this.aim.group.visible;
    const passes: [bone: boolean, others: boolean, material: MeshBasicMaterial | null][] = [
      [false, true, null],
      [true, false, this.depthOnly],
      [true, false, null],
    ];
    this.depthOnly.clippingPlanes = cuts.length > 0 ? cuts : null;
    renderer.autoClear = false;
    renderer.clear();
    const toolShown = this.tool.group.visible;
    for (const [bone, others, material] of passes) {
      this.bone.group.visible = bone;
      this.tool.group.visible = others && toolShown;
      this.extras.visible = others;
      this.aim.group.visible = others && showAim;
      scene.overrideMaterial = material;
      renderer.render(scene, camera);
    }
    scene.overrideMaterial = null;
    this.bone.group.visible = true;
    this.tool.group.visible = toolShown;
    this.aim.group.visible = showAim;
    this.extras.visible = true;
    renderer.autoClear = true;
  }

  /** The planes that cut the bone now, world frame; they move with it. */
  private cuts(camera: PerspectiveCamera): Plane[] {
    const { plan, toolPose, choices } = this;
    if (plan === null) return [];
    this.bone.group.updateMatrix();
    const planes = sectionPlanes(choices.sections, plan).map((plane) => plane.applyMatrix4(this.bone.group.matrix));
    if (choices.cutAway) {
      const at = toolPose === null ? plan.entry : new Vector3(...toolPose.translationMm);
      const axis = toolPose === null ? plan.axis : axisOf(toolPose);
      const eye = new Vector3().setFromMatrixPosition(camera.matrixWorld);
      const up = new Vector3().setFromMatrixColumn(camera.matrixWorld, 1).normalize();
      planes.push(planeThroughAxis(at, axis, eye, up));
    }
    return planes;
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0 || this.headset.worn.peek()) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, pixelRatioMax));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.orbit.resize(clientWidth / clientHeight);
    this.draw();
  }
}

/** Where the reamer's feed axis points, world frame. */
const axisOf = (pose: Pose) => new Vector3(0, 0, 1).applyQuaternion(new Quaternion(...pose.rotationXyzw));
