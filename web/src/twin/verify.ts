import { askWorker } from '../wire/ask_worker';
import type { Obstacle, Verification, VerificationReport, VerificationRequest } from './verification_worker';

/** Computes a session again in a worker of its own, which `start` makes. Throws AbortError when given up. */
export function verifyBy(
  start: () => Worker,
  request: VerificationRequest,
  onTicks: (ticks: number) => void,
  signal: AbortSignal,
): Promise<Verification | Obstacle> {
  return askWorker<VerificationRequest, VerificationReport, Verification | Obstacle>(
    start,
    request,
    signal,
    (report, { resolve }) => {
      if (report.kind === 'ticks') onTicks(report.ticks);
      else resolve(report.kind === 'verification' ? report.verification : report.obstacle);
    },
    ({ resolve }) => resolve('browser'),
  );
}
