/** Worker: fetches the surface that a session left, reads it and sorts its triangles for picking, off the page's thread. */
import { type PendingJob, fetchOnceReady } from './job_wait';
import { readPly } from './ply';
import { ApiError } from './rest';
import { sortedSurface, type SortedSurface } from './sorted_surface';

/** Page to worker: fetch this surface; `jobs` is where work is asked after. */
export interface SurfaceRequest {
  url: string;
  jobs: string;
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
  const { surface, buffers } = sortedSurface(readPly(await response.arrayBuffer()));
  page.postMessage({ kind: 'surface', surface }, buffers);
}

self.onmessage = (event: MessageEvent<SurfaceRequest>) => {
  fetchSurface(event.data).catch((error: unknown) => {
    const message = error instanceof Error ? error.message : String(error);
    page.postMessage({ kind: 'problem', message, status: error instanceof ApiError ? error.status : 0 });
  });
};
