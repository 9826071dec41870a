import { effect } from '@preact/signals';

import { deviationMm, scaleOf } from '../state/review/deviation_scale';
import { headsetMessage } from './headset_text';
import type { ReviewSession } from '../state/review/review_session';
import type { ReviewSettings } from '../state/review/review_settings';
import { toolAction } from '../state/tool_action';
import type { SortedSurface } from '../wire/sorted_surface';
import { pickBone } from './bone_picker';
import { DeviationSurface } from './deviation_surface';
import { MeasureMarks } from './measure_marks';
import { BoneScene } from './scene';
import type { SharedCamera } from './shared_camera';

/** A pointer that moved no further has clicked. */
const clickWithinPx = 5;

/** The picture of one session that is reviewed: its bone at the moment or its map, and what is measured on it. */
export class ReviewView {
  readonly scene = new BoneScene();
  private readonly marks = new MeasureMarks();
  private painted: { surface: SortedSurface; on: DeviationSurface } | null = null;
  private readonly stops: (() => void)[] = [];
  private pressedAt: { x: number; y: number } | null = null;
  private session: ReviewSession | null = null;

  constructor(
    private readonly settings: ReviewSettings,
    private readonly camera: SharedCamera,
  ) {
    const { scene } = this;
    scene.extras.add(this.marks.group);
    scene.onDrawn = () => camera.onDrawn(scene);
    scene.onInteraction = () => settings.view.change({ camera: 'own' });
    camera.add(scene);
    this.listen();
  }

  /** Shows the session, until this is disposed of. `leads`: its reamer is what the surgeon's eye follows. */
  follow(session: ReviewSession, leads: () => boolean): void {
    const { scene, settings } = this;
    const { store } = session;
    this.session = session;
    this.stops.push(
      effect(() => scene.setToolPose(store.telemetry.value?.worldFromTool ?? null)),
      effect(() => {
        if (scene.headset.worn.value) scene.headset.show(headsetMessage(store));
      }),
      effect(() => scene.setToolAction(toolAction(store.telemetry.value, store.upToDate.value))),
      effect(() => scene.setTouching(store.touching.value)),
      effect(() => scene.setBonePose(store.telemetry.value?.worldFromBoneRest ?? null)),
      // Its glass would change the colours of a map.
      effect(() => scene.setToolShown(settings.reamerShown.value && session.mapShown.value === null)),
      effect(() => {
        const choices = settings.view.shown.value;
        scene.setView(leads() ? choices : { ...choices, camera: 'own' }, false);
      }),
      effect(() => this.showMap(session)),
      effect(() => {
        this.marks.show(session.places.value.map(({ at }) => at));
        scene.invalidate();
      }),
    );
  }

  /** Measures at the middle of the picture. */
  measureAtMiddle(): void {
    const box = this.scene.canvas.getBoundingClientRect();
    this.measureAt(box.left + box.width / 2, box.top + box.height / 2);
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    this.camera.remove(this.scene);
    this.scene.onDrawn = () => undefined;
    this.marks.clear();
    this.scene.replaceBone(null);
    this.painted?.on.dispose();
    this.scene.dispose();
  }

  private showMap(session: ReviewSession): void {
    const map = session.mapShown.value;
    const scale = this.settings.scale.value;
    if (map === null) return this.scene.replaceBone(null);
    if (this.painted?.surface !== map.surface) {
      this.painted?.on.dispose();
      this.painted = { surface: map.surface, on: new DeviationSurface(map.surface) };
    }
    const { on } = this.painted;
    on.paint(map.deviation.bytes, map.deviation.code);
    on.setScale(scaleOf(map.name, scale));
    this.scene.replaceBone(on);
  }

  private listen(): void {
    const { canvas } = this.scene;
    canvas.addEventListener('pointerdown', (event) => {
      this.pressedAt = event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
    });
    canvas.addEventListener('pointerup', (event) => {
      const from = this.pressedAt;
      this.pressedAt = null;
      if (from === null || !this.settings.measuring.peek()) return;
      if (Math.hypot(event.clientX - from.x, event.clientY - from.y) <= clickWithinPx)
        this.measureAt(event.clientX, event.clientY);
    });
    canvas.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter' || !this.settings.measuring.peek()) return;
      event.preventDefault();
      this.measureAtMiddle();
    });
  }

  private measureAt(clientX: number, clientY: number): void {
    const { scene, session } = this;
    if (session === null) return;
    const { group, cuts } = scene.seenBone;
    const found = pickBone(group, scene.rayAt(clientX, clientY), cuts);
    if (found === null) return session.measureAt(null);
    const map = session.mapShown.peek();
    const byte = map?.deviation.bytes[found.corner];
    const mm = map === null || byte === undefined ? null : deviationMm(byte, map.deviation.code);
    session.measureAt({ at: found.place, deviation: map === null || mm === null ? null : { mm, to: map.name } });
  }
}
