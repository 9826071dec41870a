import type { CaseApi } from '../../wire/case_api';
import type { Job } from '../../wire/rest_types';
import { ApiError } from '../../wire/rest';

const pollMs = 300;
const pollWhileLostMs = 1500;

export const isUnderWay = (job: Job | null): boolean => job?.state === 'waiting' || job?.state === 'running';

export interface JobCallbacks {
  api: Pick<CaseApi, 'job'>;
  onJob: (job: Job) => void;
  /** Whether the server does not answer; its last report may be old. */
  onSilence: (silent: boolean) => void;
  pause: (ms: number) => Promise<void>;
}

/** Follows a job until it ends, through breaks of the link; the ended job, or null when `signal` ended the watch. */
export async function followJob(first: Job, callbacks: JobCallbacks, signal: AbortSignal): Promise<Job | null> {
  let job = first;
  let silent = false;
  callbacks.onJob(job);
  while (isUnderWay(job)) {
    await callbacks.pause(silent ? pollWhileLostMs : pollMs);
    if (signal.aborted) return null;
    try {
      job = await callbacks.api.job(job.id);
      if (silent) callbacks.onSilence(false);
      silent = false;
    } catch (error) {
      if (error instanceof ApiError && error.status === 404) throw error;
      if (!silent) callbacks.onSilence(true);
      silent = true;
    }
    if (signal.aborted) return null;
    callbacks.onJob(job);
  }
  return job;
}

export const pause = (ms: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, ms));
