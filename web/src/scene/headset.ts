import { signal } from '@preact/signals';
import {
  CanvasTexture,
  Group,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  PlaneGeometry,
  Quaternion,
  Vector3,
  type WebGLRenderer,
} from 'three';

import { messageOf } from '../wire/rest';

/** The bone is seen so many times its size, at this distance from the eyes when the headset is put on. */
const magnification = 4;
const beginsAtMm = 550;
const mmPerMetre = 1000;
/** A stick held to its end makes the bone grow or shrink by this factor each second. */
const growPerSecond = 2;
const magnificationLeast = 0.5;
const magnificationMost = 20;
const stickRests = 0.15;
/** Metres, of the eyes. */
const near = 0.05;
const far = 20;

/** What is said in sight of the wearer, who sees nothing else of the page. */
export interface HeadsetMessage {
  text: string;
  /** What is seen is not of this moment, or something should be done. */
  warns: boolean;
}

/** From where a picture is seen that is about to be seen in the headset. World frame, mm. */
export interface Standpoint {
  eye: Vector3;
  target: Vector3;
}

/**
 * The picture in a headset (WebXR). The wearer stands upright before the bone, which the trigger grabs and the stick
 * makes larger or smaller. Draws at every frame while it is worn.
 */
export class Headset {
  /** Whether this browser has a headset for pictures; false until it has answered. */
  readonly available = signal(false);
  readonly worn = signal(false);
  /** Why it could not be put on, in the browser's words. */
  readonly problem = signal<string | null>(null);
  /** Moves with the wearer's head. */
  readonly camera = new PerspectiveCamera(60, 1, near, far);
  /** Metres around the wearer's head at first into the world's mm. */
  readonly room = new Group();
  private readonly caption = new HeadsetCaption();
  private grabbed: { hand: Group; begun: Matrix4; room: Matrix4 } | null = null;
  private drawnAtMs = 0;
  private readonly stops: (() => void)[] = [];

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly draw: () => void,
    private readonly onEnd: () => void,
  ) {
    this.room.matrixAutoUpdate = false;
    this.camera.add(this.caption.mesh);
    this.room.add(this.camera);
    for (const hand of this.hands()) this.room.add(hand);
    void this.look();
    const looksAgain = () => void this.look();
    navigator.xr?.addEventListener('devicechange', looksAgain);
    this.stops.push(() => navigator.xr?.removeEventListener('devicechange', looksAgain));
  }

  show(message: HeadsetMessage): void {
    this.caption.show(message);
  }

  /**
   * To be called at a person's click: browsers let nobody else put it on. `standpoint` is read once the headset is
   * ready, which may be seconds later.
   */
  async putOn(standpoint: () => Standpoint): Promise<void> {
    if (this.worn.value || navigator.xr === undefined) return;
    this.problem.value = null;
    try {
      const session = await navigator.xr.requestSession('immersive-vr', { optionalFeatures: ['local-floor'] });
      session.addEventListener('end', () => this.onSessionEnd());
      const { xr } = this.renderer;
      xr.enabled = true;
      xr.setReferenceSpaceType('local');
      await xr.setSession(session);
      // Only now: bone that came meanwhile has found no headset to place.
      this.place(standpoint());
      this.worn.value = true;
      this.drawnAtMs = performance.now();
      this.renderer.setAnimationLoop(() => this.frame());
    } catch (error) {
      this.renderer.xr.enabled = false;
      this.problem.value = messageOf(error);
    }
  }

  /** Places the wearer before the target; also while the headset is worn, when its bone arrives. Ends a grab. */
  place(from: Standpoint): void {
    this.grabbed = null;
    this.room.matrix.copy(roomBefore(from, magnification));
    this.room.updateMatrixWorld(true);
  }

  async takeOff(): Promise<void> {
    await this.renderer.xr.getSession()?.end();
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    void this.takeOff();
    this.caption.dispose();
  }

  private async look(): Promise<void> {
    // Some browsers have the interface and refuse the question.
    this.available.value = (await navigator.xr?.isSessionSupported('immersive-vr').catch(() => false)) ?? false;
  }

  private onSessionEnd(): void {
    this.renderer.setAnimationLoop(null);
    this.renderer.xr.enabled = false;
    this.grabbed = null;
    this.worn.value = false;
    this.onEnd();
  }

  private hands(): Group[] {
    return [0, 1].map((i) => {
      const hand = this.renderer.xr.getController(i);
      hand.addEventListener('selectstart', () => this.grab(hand));
      hand.addEventListener('selectend', () => {
        if (this.grabbed?.hand === hand) this.grabbed = null;
      });
      return hand;
    });
  }

  private grab(hand: Group): void {
    hand.updateMatrix();
    this.grabbed = { hand, begun: hand.matrix.clone(), room: this.room.matrix.clone() };
  }

  private frame(): void {
    const nowMs = performance.now();
    const seconds = Math.min((nowMs - this.drawnAtMs) / 1000, 0.1);
    this.drawnAtMs = nowMs;
    if (this.grabbed !== null) {
      const { hand, begun, room } = this.grabbed;
      hand.updateMatrix();
      this.room.matrix.copy(carried(room, begun, hand.matrix));
    }
    const stick = this.stick();
    if (stick !== 0)
      this.room.matrix.copy(grown(this.room.matrix, this.camera.matrix, growPerSecond ** (stick * seconds)));
    this.room.updateMatrixWorld(true);
    this.draw();
  }

  /** Up: 1, down: -1; of whichever is moved furthest. */
  private stick(): number {
    const session = this.renderer.xr.getSession();
    let furthest = 0;
    for (const source of session?.inputSources ?? []) {
      const up = -(source.gamepad?.axes[3] ?? 0);
      if (Math.abs(up) > Math.max(Math.abs(furthest), stickRests)) furthest = up;
    }
    return furthest;
  }
}

/** World from room, where the wearer stands upright (z is superior), looks as from the standpoint and sees it enlarged. */
export function roomBefore({ eye, target }: Standpoint, times: number): Matrix4 {
  const scale = mmPerMetre / times;
  const ahead = target.clone().sub(eye);
  const level = new Vector3(ahead.x, ahead.y, 0);
  if (level.lengthSq() < 1e-6 * ahead.lengthSq()) level.set(0, 1, 0);
  level.normalize();
  const up = new Vector3(0, 0, 1);
  const right = new Vector3().crossVectors(level, up);
  const turn = new Matrix4().makeBasis(right, up, level.clone().negate());
  const at = target.clone().addScaledVector(level, -(beginsAtMm / mmPerMetre) * scale);
  return new Matrix4().compose(at, new Quaternion().setFromRotationMatrix(turn), new Vector3(scale, scale, scale));
}

/** The room while a hand carries the world: what the hand held when it began it still holds. */
export function carried(room: Matrix4, handThen: Matrix4, handNow: Matrix4): Matrix4 {
  return room.clone().multiply(handThen).multiply(handNow.clone().invert());
}

/** The world `factor` times larger around what is half a metre before the head; within what is useful. */
export function grown(room: Matrix4, head: Matrix4, factor: number): Matrix4 {
  const now = mmPerMetre / new Vector3().setFromMatrixScale(room).x;
  const wanted = Math.min(Math.max(now * factor, magnificationLeast), magnificationMost);
  const by = now / wanted;
  const middle = new Vector3(0, 0, -beginsAtMm / mmPerMetre).applyMatrix4(head);
  return room
    .clone()
    .multiply(new Matrix4().makeTranslation(middle))
    .multiply(new Matrix4().makeScale(by, by, by))
    .multiply(new Matrix4().makeTranslation(middle.negate()));
}

const widthPx = 1024;
const heightPx = 96;
/** Metres from the eyes. */
const ahead = 0.9;
const below = 0.3;
const width = 0.6;

/** A line of words that stays in sight: below the middle, wherever the head turns. */
export class HeadsetCaption {
  private readonly canvas = document.createElement('canvas');
  private readonly texture = new CanvasTexture(this.canvas);
  private readonly material = new MeshBasicMaterial({
    map: this.texture,
    transparent: true,
    depthTest: false,
    toneMapped: false,
  });
  readonly mesh = new Mesh(new PlaneGeometry(width, (width * heightPx) / widthPx), this.material);
  private shown: HeadsetMessage = { text: '', warns: false };

  constructor() {
    this.canvas.width = widthPx;
    this.canvas.height = heightPx;
    this.mesh.position.set(0, -below, -ahead);
    this.mesh.renderOrder = 1000;
    this.mesh.visible = false;
  }

  show(message: HeadsetMessage): void {
    if (message.text === this.shown.text && message.warns === this.shown.warns) return;
    this.shown = message;
    this.mesh.visible = message.text !== '';
    const context = this.canvas.getContext('2d');
    if (context === null) return;
    context.clearRect(0, 0, widthPx, heightPx);
    context.fillStyle = message.warns ? '#8c1d18' : 'rgb(20 28 32 / 0.86)';
    context.beginPath();
    context.roundRect(0, 0, widthPx, heightPx, 24);
    context.fill();
    context.fillStyle = '#ffffff';
    context.font = '600 46px system-ui, sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.fillText(message.text, widthPx / 2, heightPx / 2, widthPx - 40);
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.material.dispose();
    this.texture.dispose();
  }
}
