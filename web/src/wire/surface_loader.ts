import { askWorker } from './ask_worker';
import { ApiError, credentials } from './rest';
import type { SortedSurface } from './sorted_surface';
import type { SurfaceReport, SurfaceRequest } from './surface_worker';

/**
 * Fetches the surface that a session left, in a worker that lives as long. Throws ApiError in the server's words, and
 * AbortError when given up.
 */
export function loadSurface(
  request: SurfaceRequest,
  onProgress: (share: number) => void,
  signal: AbortSignal,
): Promise<SortedSurface> {
  return askWorker<SurfaceRequest, SurfaceReport, SortedSurface>(
    () => new Worker(new URL('./surface_worker.ts', import.meta.url), { type: 'module' }),
    request,
    signal,
    (report, { resolve, reject }) => {
      if (report.kind === 'making') onProgress(report.share);
      else if (report.kind === 'surface') resolve(report.surface);
      else {
        if (report.status === 401) credentials.onRefused?.();
        reject(new ApiError(report.message, report.status));
      }
    },
    ({ reject }) => reject(new ApiError('', 0)),
  );
}
