import { ApiError, credentials } from './rest';
import type { SortedSurface, SurfaceReport, SurfaceRequest } from './surface_worker';

/**
 * Fetches the surface that a session left, in a worker that lives as long. Throws ApiError in the server's words, and
 * AbortError when given up.
 */
export function loadSurface(
  request: SurfaceRequest,
  onProgress: (share: number) => void,
  signal: AbortSignal,
): Promise<SortedSurface> {
  return new Promise((resolve, reject) => {
    const worker = new Worker(new URL('./surface_worker.ts', import.meta.url), { type: 'module' });
    const end = (settle: () => void) => {
      worker.terminate();
      signal.removeEventListener('abort', giveUp);
      settle();
    };
    const giveUp = () => end(() => reject(new DOMException('given up', 'AbortError')));
    signal.addEventListener('abort', giveUp);
    worker.onerror = () => end(() => reject(new ApiError('', 0)));
    worker.onmessage = ({ data }: MessageEvent<SurfaceReport>) => {
      if (data.kind === 'making') onProgress(data.share);
      else if (data.kind === 'surface') end(() => resolve(data.surface));
      else {
        if (data.status === 401) credentials.onRefused?.();
        end(() => reject(new ApiError(data.message, data.status)));
      }
    };
    worker.postMessage(request);
  });
}
