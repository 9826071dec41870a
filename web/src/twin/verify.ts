import { askWorker } from '../wire/ask_worker';
import type { Obstacle, Verification, VerificationReport, VerificationRequest } from './verification_worker';

/** Computes a session again in a worker of its own. `causes`: where its file of causes is. Throws AbortError when given up. */
export function verify(
  causes: string,
  onTicks: (ticks: number) => void,
  signal: AbortSignal,
): Promise<Verification | Obstacle> {
  const here = (address: string) => new URL(address, document.baseURI).href;
  return askWorker<VerificationRequest, VerificationReport, Verification | Obstacle>(
    () => new Worker(new URL('./verification_worker.ts', import.meta.url), { type: 'module' }),
    { causes: here(causes), module: here('ream-twin.wasm') },
    signal,
    (report, { resolve }) => {
      if (report.kind === 'ticks') onTicks(report.ticks);
      else resolve(report.kind === 'verification' ? report.verification : report.obstacle);
    },
    ({ resolve }) => resolve('browser'),
  );
}
