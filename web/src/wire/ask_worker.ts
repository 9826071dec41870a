/** How a report of a worker settles what was asked. */
export interface Settling<Result> {
  resolve: (result: Result) => void;
  reject: (error: Error) => void;
}

/**
 * Has one piece of work done by a worker that lives as long. `onReport` gets what it says, and settles by the last;
 * `onCrash` when the worker itself fails. Throws AbortError when given up.
 */
export function askWorker<Request, Report, Result>(
  start: () => Worker,
  request: Request,
  signal: AbortSignal,
  onReport: (report: Report, settling: Settling<Result>) => void,
  onCrash: (settling: Settling<Result>) => void,
): Promise<Result> {
  return new Promise((resolve, reject) => {
    signal.throwIfAborted();
    const worker = start();
    const end = (settle: () => void) => {
      worker.terminate();
      signal.removeEventListener('abort', giveUp);
      settle();
    };
    const settling: Settling<Result> = {
      resolve: (result) => end(() => resolve(result)),
      reject: (error) => end(() => reject(error)),
    };
    const giveUp = () => settling.reject(new DOMException('given up', 'AbortError'));
    signal.addEventListener('abort', giveUp);
    worker.onerror = () => onCrash(settling);
    worker.onmessage = ({ data }: MessageEvent<Report>) => onReport(data, settling);
    worker.postMessage(request);
  });
}
