import { NeutralToneMapping, Scene, WebGLRenderer } from 'three';

import type { ScreenAxes } from '../practice/gamepad_hand';
import type { Beside, PlanFrame, Ray } from '../practice/plan_frame';
import type { SteeredView } from '../practice/pointer_hand';
import type { Hello, MeshDelta, Pose, ToolMesh } from '../wire/messages';
import { AimView } from './aim_view';
import { BoneView } from './bone_view';
import { CameraRig, type ViewName } from './camera_rig';
import { OperatingLights } from './lights';
import { ToolView } from './tool_view';

/** Beyond this the eye gains little and a tablet loses much. */
const pixelRatioMax = 2;

/** The three-dimensional picture. Draws only when something changed. */
export class BoneScene implements SteeredView {
  readonly canvas = document.createElement('canvas');
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly bone = new BoneView();
  private readonly tool = new ToolView();
  private readonly aim = new AimView();
  private readonly lights: OperatingLights;
  private readonly rig: CameraRig;
  private framedCase: string | null = null;
  private drawRequested = false;
  private drawn = 0;

  /** Throws where the browser offers no WebGL. */
  constructor() {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1.05;
    this.rig = new CameraRig(this.canvas, () => this.invalidate());
    this.lights = new OperatingLights(this.scene);
    this.scene.add(this.bone.group, this.tool.group, this.aim.group);
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  get framesDrawn(): number {
    return this.drawn;
  }
  get blockCount(): number {
    return this.bone.blockCount;
  }
  get triangleCount(): number {
    return this.renderer.info.render.triangles;
  }

  /** A new connection's picture begins. The view stays as the viewer left it unless the case is another. */
  begin(hello: Hello): void {
    this.bone.begin(hello);
    this.tool.setMesh(hello.tool);
    this.rig.setPlan(hello);
    if (this.framedCase !== hello.caseId) {
      this.framedCase = hello.caseId;
      this.rig.look('plan');
    }
    this.invalidate();
  }

  apply(mesh: MeshDelta): void {
    this.bone.apply(mesh);
    this.invalidate();
  }

  /** Another reamer from here on; drawn once its pose is told. */
  setTool(tool: ToolMesh): void {
    this.tool.setMesh(tool);
    this.invalidate();
  }

  setToolPose(pose: Pose | null): void {
    this.tool.setPose(pose);
    this.invalidate();
  }

  /** Tool and bone come with the same message, so that they are drawn as they were at one moment. */
  setBonePose(worldFromBoneRest: Pose | null): void {
    this.bone.setPose(worldFromBoneRest);
    this.invalidate();
  }

  setToolShown(shown: boolean): void {
    this.tool.setShown(shown);
    this.invalidate();
  }

  /** Where the hand aims beside the plan; null: nobody steers here, and the picture is turned by pointer and keys. */
  setAim(plan: PlanFrame | null, place: Beside): void {
    this.rig.setGuided(plan !== null);
    this.aim.set(plan, place);
    this.invalidate();
  }

  rayAt(clientX: number, clientY: number): Ray {
    return this.rig.rayAt(clientX, clientY);
  }

  screenAxes(plan: PlanFrame): ScreenAxes {
    const { right, up } = this.rig.screenDirections();
    return { right: plan.beside(right), up: plan.beside(up) };
  }

  turnBy(rightPx: number, downPx: number): void {
    this.rig.turnBy(rightPx, downPx);
    this.invalidate();
  }

  zoomBy(factor: number): void {
    this.rig.zoom(factor);
    this.invalidate();
  }

  look(view: ViewName): void {
    this.rig.look(view);
    this.invalidate();
  }

  /** What nobody sees is not drawn; resize() draws it when it is shown again. */
  private invalidate(): void {
    if (this.drawRequested || !this.canvas.isConnected) return;
    this.drawRequested = true;
    requestAnimationFrame(() => {
      this.drawRequested = false;
      this.draw();
    });
  }

  private draw(): void {
    this.rig.camera.updateMatrixWorld();
    this.lights.follow(this.rig.camera);
    this.renderer.render(this.scene, this.rig.camera);
    ++this.drawn;
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, pixelRatioMax));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.rig.resize(clientWidth / clientHeight);
    this.draw();
  }
}
