import { effect, signal } from '@preact/signals';
import { Matrix4, Vector3 } from 'three';

import { meshSection } from '../ct/mesh_section';
import { type PlaneName, planeNames, type SlicePlane, slicePlanes } from '../ct/orientation';
import { SliceCache } from '../ct/slice_cache';
import { SliceLayout } from '../ct/slice_layout';
import { numberOf, VolumeFrame } from '../ct/volume_frame';
import { windowPresets } from '../ct/window_level';
import type { Store } from '../state/store';
import { CaseApi } from '../wire/case_api';
import type { CaseCt } from '../wire/rest_types';
import type { Hello, Triple } from '../wire/messages';
import { FrameRequest } from './frame_request';
import { SlicePicture } from './slice_picture';
import { poseMatrix } from './pose_matrix';

/** Half of what a slice shows around the planned entry. */
const fieldMm = 36;
/** A reamer that is taken further away than this is not followed any more. */
const followsMm = 26;
/** A dark edge, and the line itself. */
const reamerStrokes = [
  ['#10161a', 3.5],
  ['#ffd166', 1.75],
] as const;
const planColour = '#2dd4a7';

interface View {
  canvas: HTMLCanvasElement;
  picture: SlicePicture;
}

/** Slices of the CT through the tip of the reamer, with its outline and the planned axis, as the stream sends them. */
export class LiveSlices {
  /** Why a slice is not there; null: it is, or on its way. */
  readonly problem = signal<string | null>(null);
  /** Some picture is of another slice than the wanted one, or there is none yet. */
  readonly pending = signal(true);
  readonly planes: Record<PlaneName, SlicePlane>;
  private readonly frame: VolumeFrame;
  private readonly cache: SliceCache;
  private readonly views = new Map<PlaneName, View>();
  private readonly stop: () => void;
  private readonly drawing = new FrameRequest(() => this.draw());

  constructor(
    private readonly store: Store,
    private readonly ct: CaseCt,
    caseId: string,
  ) {
    this.frame = new VolumeFrame(ct);
    this.planes = slicePlanes(this.frame);
    const api = new CaseApi(window.location.origin);
    this.cache = new SliceCache(
      ({ of, revision, axis, index }, abort) => api.slice(caseId, of, revision, axis, index, abort),
      64 << 20,
    );
    for (const name of planeNames) {
      const picture = new SlicePicture(this.cache, () => this.invalidate());
      this.views.set(name, { canvas: document.createElement('canvas'), picture });
    }
    const stopFollowing = effect(() => {
      if (store.telemetry.value !== null || store.hello.value !== null) this.invalidate();
    });
    const resizes = new ResizeObserver(() => this.invalidate());
    for (const { canvas } of this.views.values()) resizes.observe(canvas);
    this.stop = () => {
      stopFollowing();
      resizes.disconnect();
    };
  }

  canvas(name: PlaneName): HTMLCanvasElement | undefined {
    return this.views.get(name)?.canvas;
  }

  dispose(): void {
    this.stop();
    this.cache.clear();
    this.drawing.dispose();
  }

  private invalidate(): void {
    this.drawing.request();
  }

  private draw(): void {
    const hello = this.store.hello.peek();
    if (hello === null) return;
    const boneFromTool = toolInBone(this.store);
    const place = this.frame.voxelFromWorld(placeOf(hello, boneFromTool));
    let arrived = true;
    for (const [name, view] of this.views)
      arrived = this.drawView(this.planes[name], view, hello, boneFromTool, place) && arrived;
    this.pending.value = !arrived;
    this.problem.value = [...this.views.values()].map(({ picture }) => picture.problem).find((p) => p !== null) ?? null;
  }

  /** Whether the slice that is wanted is here. */
  private drawView(plane: SlicePlane, view: View, hello: Hello, boneFromTool: Matrix4 | null, place: Triple): boolean {
    const { canvas, picture } = view;
    const { clientWidth: width, clientHeight: height } = canvas;
    const onto = canvas.getContext('2d');
    if (onto === null || width === 0 || height === 0) return false;
    const ratio = Math.min(window.devicePixelRatio, 2);
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const within = this.frame.clampVoxel([...place]);
    const look = {
      centre: this.frame.voxelFromWorld([...hello.axisEntryMm]),
      pxPerMm: Math.min(width, height) / (2 * fieldMm),
    };
    const layout = new SliceLayout(this.frame, plane, look, width, height);
    const arrived = picture.update({
      ...{ plane, frame: this.frame, index: this.frame.sliceAt(plane.axis, within) },
      ...{ huRevision: this.ct.revision, labelsRevision: null, window: windowPresets.bone, previewFromHu: null },
    });
    onto.setTransform(1, 0, 0, 1, 0, 0);
    onto.fillStyle = '#000';
    onto.fillRect(0, 0, canvas.width, canvas.height);
    picture.draw(onto, layout, ratio);
    onto.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.drawPlan(onto, layout, hello);
    if (boneFromTool !== null) this.drawReamer(onto, layout, plane, hello, boneFromTool, within);
    return arrived;
  }

  /** The planned axis as it is seen from in front of the slice; its thick part is the planned depth. */
  private drawPlan(onto: CanvasRenderingContext2D, layout: SliceLayout, hello: Hello): void {
    const entry = new Vector3(...hello.axisEntryMm);
    const along = (mm: number) => {
      const point = entry.clone().addScaledVector(new Vector3(...hello.axisDirection), mm);
      return layout.pointToPicture(point.toArray());
    };
    for (const [from, to, width] of [
      [-30, 20, 1.25],
      [0, hello.plannedDepthMm, 4],
    ] as const) {
      const [a, b] = [along(from), along(to)];
      onto.strokeStyle = planColour;
      onto.lineWidth = width;
      onto.beginPath();
      onto.moveTo(a.x, a.y);
      onto.lineTo(b.x, b.y);
      onto.stroke();
    }
  }

  /** Where the slice cuts the reamer. */
  private drawReamer(
    onto: CanvasRenderingContext2D,
    layout: SliceLayout,
    plane: SlicePlane,
    { tool }: Hello,
    boneFromTool: Matrix4,
    within: Triple,
  ): void {
    const toolFromBone = boneFromTool.clone().invert();
    const normal = new Vector3(...this.frame.directions[numberOf(plane.axis)]).transformDirection(toolFromBone);
    const through = new Vector3(...this.frame.worldFromVoxel([...within])).applyMatrix4(toolFromBone);
    const pieces = meshSection(tool, normal, through);
    const end = new Vector3();
    onto.beginPath();
    for (let i = 0; i + 2 < pieces.length; i += 3) {
      end.fromArray(pieces, i).applyMatrix4(boneFromTool);
      const { x, y } = layout.pointToPicture(end.toArray());
      if (i % 6 === 0) onto.moveTo(x, y);
      else onto.lineTo(x, y);
    }
    for (const [colour, width] of reamerStrokes) {
      onto.strokeStyle = colour;
      onto.lineWidth = width;
      onto.stroke();
    }
  }
}

/** The reamer as the bone at rest has it, which is where the CT is; null while it is not known. */
function toolInBone(store: Store): Matrix4 | null {
  const telemetry = store.telemetry.peek();
  if (telemetry?.worldFromTool === undefined || telemetry.worldFromTool === null) return null;
  const worldFromTool = poseMatrix(telemetry.worldFromTool);
  const moved = telemetry.worldFromBoneRest;
  return moved === null ? worldFromTool : poseMatrix(moved).invert().multiply(worldFromTool);
}

/** Through the reamer's tip, or through the planned entry while the reamer is away. */
function placeOf(hello: Hello, boneFromTool: Matrix4 | null): [number, number, number] {
  const entry = new Vector3(...hello.axisEntryMm);
  const tip = boneFromTool === null ? entry : new Vector3().setFromMatrixPosition(boneFromTool);
  return (tip.distanceTo(entry) > followsMm ? entry : tip).toArray();
}
