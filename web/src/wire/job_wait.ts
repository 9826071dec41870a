import { ApiError } from './rest';
import type { Job } from './rest_types';

/** Work that the server does, as far as waiting for it goes. */
export type PendingJob = Pick<Job, 'id' | 'state' | 'share' | 'step' | 'problem'>;

const retryAfterMs = 400;

/** Asks after a job until it has ended; throws ApiError in its words where it failed. */
export async function waitForJob(
  begun: PendingJob,
  getJob: (id: string) => Promise<PendingJob>,
  onProgress: (share: number) => void,
  signal?: AbortSignal,
): Promise<PendingJob> {
  for (let job = begun; ; job = await getJob(job.id)) {
    signal?.throwIfAborted();
    onProgress(job.share);
    if (job.state === 'done') return job;
    if (job.state === 'failed' || job.state === 'cancelled')
      throw new ApiError(job.problem?.detail ?? job.step, job.problem?.status ?? 500);
    await new Promise((resolve) => setTimeout(resolve, retryAfterMs));
  }
}

/** Asks for something that may have to be made first (202 with the job that does so); gives the answer that has it. */
export async function fetchOnceReady(
  get: () => Promise<Response>,
  getJob: (id: string) => Promise<PendingJob>,
  onProgress: (share: number) => void,
  signal?: AbortSignal,
): Promise<Response> {
  for (;;) {
    const response = await get();
    if (response.status !== 202) return response;
    await waitForJob((await response.json()) as PendingJob, getJob, onProgress, signal);
  }
}
