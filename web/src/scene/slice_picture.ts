import type { SlicePlane } from '../ct/orientation';
import { paintSlice } from '../ct/paint_slice';
import type { SliceCache, SliceKey } from '../ct/slice_cache';
import type { SliceLayout } from '../ct/slice_layout';
import { numberOf, voxelAxes, type VolumeFrame } from '../ct/volume_frame';
import { brightnessTable, type WindowLevel } from '../ct/window_level';
import { messageOf } from '../wire/rest';

export interface SliceWanted {
  plane: SlicePlane;
  frame: VolumeFrame;
  index: number;
  huRevision: number;
  /** Null: there are no labels, or they are not to be seen. */
  labelsRevision: number | null;
  window: WindowLevel;
  previewFromHu: number | null;
}

/** Slices on either side of the shown one that are fetched ahead. */
const prefetchDistance = 3;
const retryAfterMs = 2000;

/** The newest picture of one plane's slices: fetches what is wanted and keeps what was painted last. */
export class SlicePicture {
  private readonly canvas = new OffscreenCanvas(1, 1);
  private readonly context = this.canvas.getContext('2d');
  private pixels = new ImageData(1, 1);
  private paintedAs = '';
  private brightness = new Uint8Array(0);
  private brightnessOf: WindowLevel | null = null;
  /** Of the slice in the picture; null before the first. */
  shownIndex: number | null = null;
  /** Why the wanted slice is not there. */
  problem: string | null = null;
  /** Until then nothing is asked for again. */
  private retryAtMs = 0;

  constructor(
    private readonly cache: SliceCache,
    private readonly onArrived: () => void,
  ) {}

  /** Paints the wanted slice if it is here and asks for it if not; whether it is what the picture shows. */
  update(wanted: SliceWanted): boolean {
    const huKey: SliceKey = { of: 'hu', revision: wanted.huRevision, axis: wanted.plane.axis, index: wanted.index };
    const labelsKey: SliceKey | null =
      wanted.labelsRevision === null ? null : { ...huKey, of: 'labels', revision: wanted.labelsRevision };
    const hu = this.peekOrFetch(huKey);
    const labels = labelsKey === null ? null : this.peekOrFetch(labelsKey);
    if (hu === null) return false;
    this.prefetchAround(huKey, labelsKey, wanted);
    const { widthHu, levelHu } = wanted.window;
    const name = [
      ...[wanted.plane.axis, wanted.index, wanted.huRevision, labels === null ? null : wanted.labelsRevision],
      ...[widthHu, levelHu, wanted.previewFromHu],
    ].join();
    if (name !== this.paintedAs) {
      this.paint(wanted, new Int16Array(hu), labels === null ? null : new Uint8Array(labels));
      this.paintedAs = name;
    }
    this.shownIndex = wanted.index;
    return true;
  }

  draw(onto: CanvasRenderingContext2D, layout: SliceLayout, pixelRatio: number): void {
    if (this.shownIndex === null) return;
    const [a, b, c, d, e, f] = layout.transform();
    onto.setTransform(a * pixelRatio, b * pixelRatio, c * pixelRatio, d * pixelRatio, e * pixelRatio, f * pixelRatio);
    onto.imageSmoothingEnabled = true;
    onto.drawImage(this.canvas, 0, 0);
    onto.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
  }

  /** Nothing painted so far is to be seen again. */
  forget(): void {
    this.paintedAs = '';
    this.shownIndex = null;
  }

  private peekOrFetch(key: SliceKey): ArrayBuffer | null {
    const found = this.cache.peek(key);
    if (found !== null) return found;
    if (performance.now() < this.retryAtMs) return null;
    this.cache.get(key).then(
      () => {
        this.problem = null;
        this.onArrived();
      },
      (error: unknown) => {
        if (error instanceof DOMException && error.name === 'AbortError') return;
        this.problem = messageOf(error);
        this.retryAtMs = performance.now() + retryAfterMs;
        setTimeout(this.onArrived, retryAfterMs);
        this.onArrived();
      },
    );
    return null;
  }

  private prefetchAround(hu: SliceKey, labels: SliceKey | null, { frame, plane }: SliceWanted): void {
    const count = frame.dims[numberOf(plane.axis)];
    const keys: SliceKey[] = [];
    for (let step = 1; step <= prefetchDistance; ++step) {
      for (const index of [hu.index + step, hu.index - step]) {
        if (index < 0 || index >= count) continue;
        keys.push({ ...hu, index });
        if (labels !== null) keys.push({ ...labels, index });
      }
    }
    this.cache.prefetch(keys);
  }

  private paint(wanted: SliceWanted, hu: Int16Array<ArrayBuffer>, labels: Uint8Array<ArrayBuffer> | null): void {
    const [first, second] = voxelAxes.filter((axis) => axis !== wanted.plane.axis).map(numberOf);
    const columns = wanted.frame.dims[first ?? 0];
    const rows = wanted.frame.dims[second ?? 1];
    if (hu.length !== columns * rows) return;
    if (this.pixels.width !== columns || this.pixels.height !== rows) {
      this.pixels = new ImageData(columns, rows);
      this.canvas.width = columns;
      this.canvas.height = rows;
    }
    if (this.brightnessOf !== wanted.window) {
      this.brightness = brightnessTable(wanted.window);
      this.brightnessOf = wanted.window;
    }
    const fitting = labels?.length === hu.length ? labels : null;
    const { brightness } = this;
    const options = { brightness, previewFromHu: wanted.previewFromHu, showLabels: fitting !== null };
    paintSlice({ columns, rows, hu, labels: fitting }, options, this.pixels.data);
    this.context?.putImageData(this.pixels, 0, 0);
  }
}
