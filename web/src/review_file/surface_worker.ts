/** Worker: computes the bone that a session left, and sorts the triangles of its surface for picking. */
import { Box3, BufferAttribute, BufferGeometry } from 'three';

import { poseMatrix } from '../scene/pose_matrix';
import { causeFile, PartFileError, partsOf } from '../twin/part_file';
import { type GridSurface, TwinModule } from '../twin/twin_module';
import { StreamDecoder } from '../wire/decode';
import type { Surface } from '../wire/ply';
import type { Pose } from '../wire/pose';
import { sortedSurface, type SortedSurface } from '../wire/sorted_surface';
import { type Obstacle, obstacleOf } from './obstacle';

export interface SurfaceRequest {
  module: Blob;
  causes: Blob;
  /** The stream's first message, which says where the grid lies. */
  hello: Uint8Array<ArrayBuffer>;
}

/** The last is the surface, or that it cannot be computed. */
export type SurfaceReport =
  | { kind: 'ticks'; ticks: number }
  | { kind: 'surface'; surface: SortedSurface }
  | { kind: 'failed'; obstacle: Obstacle };

const page = self as unknown as { postMessage(report: SurfaceReport, transfer?: ArrayBuffer[]): void };
const reportEveryMs = 250;

async function computed({ module, causes, hello }: SurfaceRequest): Promise<void> {
  const first = new StreamDecoder().decode(hello);
  if (first.kind !== 'hello') throw new PartFileError('the file does not begin with a hello');
  const twin = await TwinModule.load(await module.arrayBuffer());
  let told = performance.now();
  for await (const part of partsOf(causeFile, causes.stream())) {
    if (twin.take(part) !== 'agrees') throw new PartFileError('the causes do not agree with their hashes');
    if (performance.now() - told < reportEveryMs) continue;
    told = performance.now();
    page.postMessage({ kind: 'ticks', ticks: twin.agreedTicks });
  }
  const { surface, buffers } = sortedSurface(inWorld(twin.wholeSurface(), first.hello.worldFromGrid));
  page.postMessage({ kind: 'surface', surface }, buffers);
}

function inWorld({ positions, normals, indices }: GridSurface, worldFromGrid: Pose): Surface {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  // In place.
  geometry.applyMatrix4(poseMatrix(worldFromGrid));
  const { min, max } = new Box3().setFromArray(positions);
  return { positions, normals, indices, low: [min.x, min.y, min.z], high: [max.x, max.y, max.z] };
}

self.onmessage = ({ data }: MessageEvent<SurfaceRequest>) => {
  computed(data).catch((error: unknown) => {
    console.error(error);
    page.postMessage({ kind: 'failed', obstacle: obstacleOf(error) });
  });
};
