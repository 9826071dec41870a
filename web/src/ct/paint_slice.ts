import { partColours, previewColour } from './palette';

export interface SlicePixels {
  columns: number;
  rows: number;
  hu: Int16Array<ArrayBuffer>;
  /** Of the same size, or null where there are none (yet). */
  labels: Uint8Array<ArrayBuffer> | null;
}

export interface PaintOptions {
  /** Brightness at hu + 32768. */
  brightness: Uint8Array<ArrayBuffer>;
  /** HU from which pixels are tinted; null: no preview. */
  previewFromHu: number | null;
  showLabels: boolean;
}

const fillShare = 0.28;
const edgeShare = 0.9;
const previewShare = 0.45;

/** Pixels of a colour over each of the 256 greys; red is the lowest byte, as machines of today (little endian) have it. */
function overGreys([red, green, blue]: readonly [number, number, number], share: number): Uint32Array {
  return Uint32Array.from({ length: 256 }, (_, grey) => {
    const mix = (colour: number) => (grey + (colour - grey) * share) | 0;
    return 0xff000000 | (mix(blue) << 16) | (mix(green) << 8) | mix(red);
  });
}

const plain = overGreys([0, 0, 0], 0);
const areas = partColours.map((colour) => overGreys(colour, fillShare));
const edges = partColours.map((colour) => overGreys(colour, edgeShare));
const tinted = overGreys(previewColour, previewShare);

/** Draws a slice into RGBA pixels: grey values, over them the parts (edges stronger than areas) or the preview. */
export function paintSlice(slice: SlicePixels, options: PaintOptions, out: Uint8ClampedArray<ArrayBuffer>): void {
  const { hu, columns } = slice;
  const labels = options.showLabels ? slice.labels : null;
  const pixels = new Uint32Array(out.buffer, out.byteOffset, hu.length);
  const { brightness } = options;
  const preview = options.previewFromHu ?? Infinity;
  for (let i = 0; i < hu.length; ++i) {
    const value = hu[i] as number;
    const grey = brightness[value + 32768] as number;
    const label = labels === null ? 0 : (labels[i] as number);
    let colours = value >= preview ? tinted : plain;
    if (label !== 0 && labels !== null) colours = (isEdge(labels, i, columns) ? edges : areas)[label] ?? tinted;
    pixels[i] = colours[grey] as number;
  }
}

function isEdge(labels: Uint8Array, i: number, columns: number): boolean {
  const label = labels[i];
  const column = i % columns;
  return (
    (column > 0 && labels[i - 1] !== label) ||
    (column < columns - 1 && labels[i + 1] !== label) ||
    (i >= columns && labels[i - columns] !== label) ||
    (i + columns < labels.length && labels[i + columns] !== label)
  );
}
