/** Worker: computes a session's bone again from a file of causes, off the page's thread. */
import { causeFile, isDamage, partsOf } from './part_file';
import { type Outcome, TwinModule } from './twin_module';

/** Page to worker: what is computed, and by what; each where it is, or itself. */
export interface VerificationRequest {
  causes: string | Blob;
  module: string | Blob;
}

/** How a computation ended: `ticks` agreed before anything else was found, of `recordedTicks` where that is known. */
export interface Verification {
  outcome: Outcome;
  ticks: number;
  recordedTicks: number | null;
}

/** Why there is no verification: the files did not arrive, or this browser cannot compute the bone. */
export type Obstacle = 'connection' | 'browser';

/** Worker to page; the last is the verification, or why there is none. */
export type VerificationReport =
  | { kind: 'ticks'; ticks: number }
  | { kind: 'verification'; verification: Verification }
  | { kind: 'obstacle'; obstacle: Obstacle };

const page = self as unknown as { postMessage(report: VerificationReport): void };
const reportEveryMs = 1000;

class NotFetched extends Error {}

/** Whole, so that a connection that breaks is not taken for a damaged file. */
async function fetched(url: string | Blob): Promise<Blob> {
  if (typeof url !== 'string') return url;
  try {
    const response = await fetch(url);
    if (response.ok) return await response.blob();
    throw new NotFetched(`${url}: ${response.status}`);
  } catch (error) {
    throw error instanceof NotFetched ? error : new NotFetched(String(error));
  }
}

async function verified({ causes, module }: VerificationRequest): Promise<Verification> {
  const [code, file] = await Promise.all([fetched(module), fetched(causes)]);
  const twin = await TwinModule.load(await code.arrayBuffer());
  const result = (outcome: Outcome) => ({ outcome, ticks: twin.agreedTicks, recordedTicks: twin.recordedTicks });
  let told = performance.now();
  try {
    for await (const part of partsOf(causeFile, file.stream())) {
      const outcome = twin.take(part);
      if (outcome !== 'agrees') return result(outcome);
      if (performance.now() - told < reportEveryMs) continue;
      told = performance.now();
      page.postMessage({ kind: 'ticks', ticks: twin.agreedTicks });
    }
  } catch (error) {
    if (!isDamage(error)) throw error;
    console.error(error);
    return result('damaged');
  }
  return result(twin.recordedTicks === null ? 'damaged' : 'agrees');
}

self.onmessage = (event: MessageEvent<VerificationRequest>) => {
  verified(event.data).then(
    (verification) => page.postMessage({ kind: 'verification', verification }),
    (error: unknown) => {
      console.error(error);
      page.postMessage({ kind: 'obstacle', obstacle: error instanceof NotFetched ? 'connection' : 'browser' });
    },
  );
};
