/** Worker: fetches the surface that a session left, reads it and sorts its triangles for picking, off the page's thread. */
import { BufferAttribute, BufferGeometry } from 'three';
import { MeshBVH } from 'three-mesh-bvh';

import { type PendingJob, fetchOnceReady } from './job_wait';
import { readPly, type Surface } from './ply';
import { ApiError } from './rest';

/** Page to worker: fetch this surface; `jobs` is where work is asked after. */
export interface SurfaceRequest {
  url: string;
  jobs: string;
}

/** A surface and the tree of boxes around its triangles. */
export interface SortedSurface extends Surface {
  boxes: ArrayBuffer[];
}

/** Worker to page; the last is the surface or why there is none. */
export type SurfaceReport =
  | { kind: 'making'; share: number }
  | { kind: 'surface'; surface: SortedSurface }
  | { kind: 'problem'; message: string; status: number };

// The DOM's typing of `self` is a window's; a worker's postMessage takes the transfer list in second place.
const page = self as unknown as { postMessage(report: SurfaceReport, transfer?: ArrayBuffer[]): void };

async function get(url: string): Promise<Response> {
  const response = await fetch(url, { cache: 'no-store' }).catch(() => {
    throw new ApiError('', 0);
  });
  if (response.ok) return response;
  const body = (await response.json().catch(() => null)) as { detail?: string } | null;
  throw new ApiError(body?.detail ?? String(response.status), response.status);
}

async function fetchSurface({ url, jobs }: SurfaceRequest): Promise<void> {
  const getJob = async (id: string) => (await (await get(jobs + encodeURIComponent(id))).json()) as PendingJob;
  const response = await fetchOnceReady(
    () => get(url),
    getJob,
    (share) => page.postMessage({ kind: 'making', share }),
  );
  const surface = readPly(await response.arrayBuffer());
  const { positions, normals, indices } = surface;
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(indices, 1));
  // Triangles are put into another order, their corners are not.
  const { roots } = MeshBVH.serialize(new MeshBVH(geometry), { cloneBuffers: false });
  const report: SurfaceReport = { kind: 'surface', surface: { ...surface, boxes: roots } };
  page.postMessage(report, [positions.buffer, normals.buffer, indices.buffer, ...roots]);
}

self.onmessage = (event: MessageEvent<SurfaceRequest>) => {
  fetchSurface(event.data).catch((error: unknown) => {
    const message = error instanceof Error ? error.message : String(error);
    page.postMessage({ kind: 'problem', message, status: error instanceof ApiError ? error.status : 0 });
  });
};
