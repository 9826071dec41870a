import { effect, signal } from '@preact/signals';

import type { PlaneName, SlicePlane } from '../ct/orientation';
import { fittingLook, type PicturePoint, SliceLayout, type SliceLook } from '../ct/slice_layout';
import { numberOf, type VolumeFrame, voxelAxes } from '../ct/volume_frame';
import { limitWindow } from '../ct/window_level';
import type { CaseController } from '../state/case/case_controller';
import type { Framed } from '../state/case/case_store';
import type { PointMark, ViewMarks } from '../state/case/view_marks';
import type { Triple } from '../wire/rest_types';
import { FrameRequest } from './frame_request';
import { SliceInput } from './slice_input';
import { drawOverlay, markAt, type OverlayWanted } from './slice_overlay';
import { SlicePicture } from './slice_picture';

/** Of each plane, for its frame and its line in the other two views. */
export const planeColours: Record<PlaneName, string> = { axial: '#ff6b6b', coronal: '#5cd65c', sagittal: '#5aa9ff' };

const panStepPx = 30;
const zoomStep = 1.2;

/** One of the three slice views: draws when something it shows has changed, and carries the user's hand to the case. */
export class SliceView {
  readonly canvas = document.createElement('canvas');
  /** Slice that is to be seen, and how many there are. */
  readonly place = signal<{ index: number; count: number } | null>(null);
  /** The picture is of another slice than the wanted one, or why there is none. */
  readonly pending = signal(false);
  readonly problem = signal<string | null>(null);

  private readonly context = this.canvas.getContext('2d');
  private readonly picture: SlicePicture;
  private readonly look = signal<SliceLook | null>(null);
  private readonly size = signal({ width: 0, height: 0 });
  private lookedAtRevision: number | null = null;
  /** What fits the view, also when its size changes, until it is zoomed or moved. */
  private fitted: Framed | null = null;
  private held: PointMark | null = null;
  private readonly drawing = new FrameRequest(() => this.draw());
  private readonly stops: (() => void)[] = [];

  constructor(
    private readonly controller: CaseController,
    private readonly marks: ViewMarks,
    private readonly name: PlaneName,
  ) {
    this.picture = new SlicePicture(controller.slices, () => this.invalidate());
    this.canvas.tabIndex = 0;
    this.listen();
    const resizes = new ResizeObserver(() => {
      this.size.value = { width: this.canvas.clientWidth, height: this.canvas.clientHeight };
    });
    resizes.observe(this.canvas);
    this.stops.push(
      () => resizes.disconnect(),
      effect(() => this.frameNew()),
      effect(() => {
        this.watched();
        this.invalidate();
      }),
    );
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    this.drawing.dispose();
  }

  fit(framed: Framed): void {
    const { frame, plane } = this.geometry();
    const { width, height } = this.size.value;
    if (frame === null || plane === null || width === 0) return;
    this.fitted = framed;
    this.look.value = fittingLook(frame, plane, width, height, framed.box ?? undefined);
  }

  scroll(slices: number): void {
    this.moveCrossHair(this.plane()?.axis, slices);
  }

  /** A key pressed in the view; whether it meant something here. */
  key(event: KeyboardEvent): boolean {
    const { frame, plane } = this.geometry();
    if (frame === null || plane === null || event.ctrlKey || event.altKey || event.metaKey) return false;
    const arrows: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, -1],
      ArrowDown: [0, 1],
    };
    const arrow = arrows[event.key];
    if (arrow !== undefined) {
      if (event.shiftKey) this.pan(-arrow[0] * panStepPx, -arrow[1] * panStepPx);
      else if (arrow[0] !== 0) this.moveCrossHair(plane.right.axis, arrow[0] * plane.right.sign);
      else this.moveCrossHair(plane.down.axis, arrow[1] * plane.down.sign);
      return true;
    }
    const actions: Record<string, () => void> = {
      PageUp: () => this.scroll(-1),
      PageDown: () => this.scroll(1),
      '+': () => this.zoomAtCrossHair(zoomStep),
      '=': () => this.zoomAtCrossHair(zoomStep),
      '-': () => this.zoomAtCrossHair(1 / zoomStep),
      Home: () => this.fit({ box: null }),
    };
    const action = actions[event.key];
    action?.();
    return action !== undefined;
  }

  /** Everything that the picture depends on. */
  private watched(): unknown {
    const { store } = this.controller;
    return [
      [this.size.value, this.look.value, store.crossHair.value, store.window.value, store.labelsShown.value],
      [store.previewFromHu.value, store.details.value, this.marks.points.value, this.marks.plan.value],
    ];
  }

  private geometry(): { frame: VolumeFrame | null; plane: SlicePlane | null } {
    return { frame: this.controller.store.frame.value, plane: this.plane() };
  }
  private plane(): SlicePlane | null {
    return this.controller.store.planes.value?.[this.name] ?? null;
  }

  /** A new CT, or what is to be framed anew, fills the view. */
  private frameNew(): void {
    const revision = this.controller.store.details.value?.ct?.revision ?? null;
    const framed = this.controller.store.framed.value;
    if (this.size.value.width === 0 || revision === null) return;
    if (revision !== this.lookedAtRevision) this.picture.forget();
    const isNew = revision !== this.lookedAtRevision || framed !== this.framedLast;
    this.lookedAtRevision = revision;
    this.framedLast = framed;
    if (isNew) this.fit(framed);
    else if (this.fitted !== null) this.fit(this.fitted);
  }
  private framedLast: Framed | null = null;

  private invalidate(): void {
    this.drawing.request();
  }

  private overlay(): OverlayWanted | null {
    const { frame, plane } = this.geometry();
    const look = this.look.value;
    const { width: widthPx, height: heightPx } = this.size.value;
    if (frame === null || plane === null || look === null) return null;
    const layout = new SliceLayout(frame, plane, look, widthPx, heightPx);
    const { points, plan } = this.marks;
    const planes = this.controller.store.planes.value;
    const colourOf = (axis: string) =>
      planeColours[Object.values(planes ?? {}).find((other) => other.axis === axis)?.name ?? this.name];
    return {
      ...{ frame, layout, crossHair: this.controller.store.crossHair.value, widthPx, heightPx },
      points: points.value,
      plan: plan.value,
      crossHairColours: { across: colourOf(plane.down.axis), along: colourOf(plane.right.axis) },
    };
  }

  private draw(): void {
    const { canvas, context } = this;
    const { store } = this.controller;
    const { width, height } = this.size.value;
    const details = store.details.value;
    const overlay = this.overlay();
    const plane = this.plane();
    if (context === null || overlay === null || plane === null || !details?.ct || width === 0) return;
    const pixelRatio = Math.min(window.devicePixelRatio, 2);
    canvas.width = Math.round(width * pixelRatio);
    canvas.height = Math.round(height * pixelRatio);
    const index = overlay.frame.sliceAt(plane.axis, overlay.crossHair);
    const arrived = this.picture.update({
      ...{ plane, frame: overlay.frame, index, window: store.window.value, huRevision: details.ct.revision },
      labelsRevision: store.labelsShown.value ? (details.segmentation?.revision ?? null) : null,
      previewFromHu: store.previewFromHu.value,
    });
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = '#000';
    context.fillRect(0, 0, canvas.width, canvas.height);
    this.picture.draw(context, overlay.layout, pixelRatio);
    context.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    drawOverlay(context, overlay);
    this.place.value = { index, count: overlay.frame.dims[numberOf(plane.axis)] };
    this.pending.value = !arrived;
    if (this.name === 'axial') store.crossHairHu.value = arrived ? this.huAtCrossHair(overlay) : null;
    this.problem.value = this.picture.problem;
  }

  private huAtCrossHair({ frame, crossHair }: OverlayWanted): number | null {
    const { planes, details } = this.controller.store;
    const axis = planes.value?.[this.name].axis;
    const revision = details.value?.ct?.revision;
    if (axis === undefined || revision === undefined) return null;
    const bytes = this.controller.slices.peek({ of: 'hu', revision, axis, index: frame.sliceAt(axis, crossHair) });
    const [first = 'u', second = 'v'] = voxelAxes.filter((other) => other !== axis);
    const at = frame.sliceAt(first, crossHair) + frame.dims[numberOf(first)] * frame.sliceAt(second, crossHair);
    return bytes === null ? null : (new Int16Array(bytes)[at] ?? null);
  }

  private listen(): void {
    const { store } = this.controller;
    new SliceInput(this.canvas, {
      takeHold: (at) => this.takeHold(at),
      moveHeld: (at) => this.held !== null && this.moveHeld(this.held, at),
      letGo: () => (this.held = null),
      click: (at) => this.click(at),
      crossHairTo: (at) => this.withVoxel(at, (voxel, frame) => (store.crossHair.value = frame.clampVoxel(voxel))),
      placing: () => store.armed.value !== null && ['segment', 'landmarks'].includes(store.openStep.value ?? ''),
      pan: (rightPx, downPx) => this.pan(rightPx, downPx),
      zoom: (at, factor) => this.zoom(at, factor),
      scroll: (slices) => this.scroll(slices),
      window: (widthHu, levelHu) => {
        const now = store.window.value;
        store.window.value = limitWindow({ widthHu: now.widthHu + widthHu, levelHu: now.levelHu + levelHu });
      },
      hover: (at) => this.hover(at),
    });
  }

  private hover(at: PicturePoint | null): void {
    this.canvas.classList.toggle('draggable', at !== null && this.draggableAt(at) !== null);
  }

  private takeHold(at: PicturePoint): boolean {
    this.held = this.draggableAt(at);
    return this.held !== null;
  }

  /** The nearest mark that can be dragged, also where another one lies on it. */
  private draggableAt(at: PicturePoint): PointMark | null {
    const overlay = this.overlay();
    if (overlay === null) return null;
    return markAt(at, { ...overlay, points: overlay.points.filter((mark) => this.marks.draggable(mark)) });
  }

  /** Places what is to be placed, even close to a mark; where nothing is, a click on a mark chooses it. */
  private click(at: PicturePoint): void {
    if (this.held !== null && !this.controller.placesNew()) this.controller.chooseMark(this.held.of);
    else this.withVoxel(at, (voxel, frame) => this.controller.placeArmed(frame.worldFromVoxel(voxel)));
  }

  /** Along the plane's axis the point stays where it is. */
  private moveHeld(held: PointMark, at: PicturePoint): void {
    const overlay = this.overlay();
    if (overlay === null) return;
    const { frame, layout } = overlay;
    this.controller.chooseMark(held.of);
    const voxel = frame.clampVoxel(layout.toVoxel(at, frame.voxelFromWorld(held.point)));
    this.marks.move(held, frame.worldFromVoxel(voxel));
  }

  private withVoxel(at: PicturePoint, action: (voxel: Triple, frame: VolumeFrame) => void): void {
    const overlay = this.overlay();
    if (overlay !== null) action(overlay.layout.toVoxel(at, overlay.crossHair), overlay.frame);
  }

  private pan(rightPx: number, downPx: number): void {
    this.lookWith((layout) => layout.movedBy(rightPx, downPx));
  }

  private zoom(at: PicturePoint, factor: number): void {
    this.lookWith((layout) => layout.zoomedAt(at, factor));
  }

  private lookWith(change: (layout: SliceLayout) => SliceLook): void {
    const layout = this.overlay()?.layout;
    if (layout === undefined) return;
    this.fitted = null;
    this.look.value = change(layout);
  }

  private zoomAtCrossHair(factor: number): void {
    const overlay = this.overlay();
    if (overlay !== null) this.zoom(overlay.layout.toPicture(overlay.crossHair), factor);
  }

  private moveCrossHair(axis: SlicePlane['axis'] | undefined, voxels: number): void {
    const { store } = this.controller;
    const frame = store.frame.value;
    if (frame === null || axis === undefined) return;
    const moved: Triple = [...store.crossHair.value];
    moved[numberOf(axis)] += voxels;
    store.crossHair.value = frame.clampVoxel(moved);
  }
}
