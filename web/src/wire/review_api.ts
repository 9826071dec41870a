import type { Session } from './api';
import { type PendingJob, fetchOnceReady, waitForJob } from './job_wait';
import { request, requestJson } from './rest';
import type { Score } from './score_types';

export type MapName = 'plan' | 'implant';
export const exportFormats = ['html', 'pdf', 'csv', 'stl', 'ply', 'glb'] as const;
export type ExportFormat = (typeof exportFormats)[number];

/** What a byte of a deviation map means; as the server says with the map. */
export interface DeviationCode {
  /** mm of one step. */
  stepMm: number;
  /** mm of 127 steps: that much or more. */
  rangeMm: number;
  /** The byte for nothing to compare. */
  unknown: number;
}

/** How far each vertex of the surface that a session left lies from something, a byte a vertex. */
export interface DeviationBytes {
  bytes: Int8Array<ArrayBuffer>;
  code: DeviationCode;
}

export interface Annotation {
  at_s: number;
  words: string;
  /** Empty when nobody signed. */
  author: string;
}

type OnProgress = (share: number) => void;

/** Calls of the REST interface about sessions that have ended; `base` is the server's origin. */
export class ReviewApi {
  constructor(readonly base: string) {}

  session(id: string): Promise<Session> {
    return requestJson(this.url(id, ''), 'GET');
  }
  score(id: string): Promise<Score> {
    return requestJson(this.scoreUrl(id), 'GET');
  }
  scoreUrl(id: string): string {
    return this.url(id, '/score');
  }
  meshUrl(id: string): string {
    return this.url(id, '/mesh');
  }
  jobsUrl(): string {
    return `${this.base}/api/v1/jobs/`;
  }
  async trace(id: string, stride: number): Promise<string> {
    return (await request(this.url(id, `/trace?stride=${stride}`), 'GET')).text();
  }
  async annotations(id: string): Promise<Annotation[]> {
    return (await requestJson<{ annotations: Annotation[] }>(this.url(id, '/annotations'), 'GET')).annotations;
  }
  annotate(id: string, words: string, atS: number): Promise<Annotation> {
    return requestJson(this.url(id, '/annotations'), 'POST', { body: { words, at_s: atS } });
  }

  /** Waits until it is made; throws ApiError 404 where there is nothing to compare the surface with. */
  async deviation(id: string, to: MapName, onProgress: OnProgress, signal: AbortSignal): Promise<DeviationBytes> {
    const get = () => request(this.url(id, `/deviation?to=${to}`), 'GET', { signal });
    const response = await fetchOnceReady(get, this.job, onProgress, signal);
    const header = (name: string) => Number(response.headers.get(name) ?? NaN);
    const bytes = new Int8Array(await response.arrayBuffer());
    const code = {
      stepMm: header('deviation-step-mm'),
      rangeMm: header('deviation-range-mm'),
      unknown: header('deviation-unknown'),
    };
    if (bytes.length !== header('deviation-vertices') || Object.values(code).some((value) => !Number.isFinite(value)))
      throw new Error('the map does not say what its bytes mean');
    return { bytes, code };
  }

  /** Makes a file of a session; where it is when it is done. */
  async exported(id: string, format: ExportFormat, onProgress: OnProgress): Promise<string> {
    const begun = await requestJson<PendingJob>(this.url(id, '/exports'), 'POST', { body: { format } });
    const done = await waitForJob(begun, this.job, onProgress);
    return `${this.jobsUrl()}${encodeURIComponent(done.id)}/result`;
  }

  private readonly job = (id: string): Promise<PendingJob> =>
    requestJson(this.jobsUrl() + encodeURIComponent(id), 'GET');
  private url(id: string, path: string): string {
    return `${this.base}/api/v1/sessions/${encodeURIComponent(id)}${path}`;
  }
}
