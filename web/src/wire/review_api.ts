import { fetchOnceReady, waitForJob } from './job_wait';
import { RestClient } from './rest_client';
import type { Annotation, Score, Session } from './rest_types';
import { problemText } from './problem_text';

export const mapNames = ['plan', 'implant', 'wall'] as const;
export type MapName = (typeof mapNames)[number];
export const exportFormats = ['html', 'pdf', 'load', 'csv', 'parquet', 'stl', 'ply', 'glb', 'review'] as const;
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

/** How far each vertex of the surface that a session left lies from something, or how thick the bone behind it is; a byte a vertex. */
export interface DeviationBytes {
  bytes: Int8Array<ArrayBuffer>;
  code: DeviationCode;
}

type OnProgress = (share: number) => void;

/** Calls of the REST interface about sessions that have ended; `base` is the server's origin. */
export class ReviewApi {
  private readonly rest: RestClient;

  constructor(base: string) {
    this.rest = new RestClient(base);
  }

  session(id: string): Promise<Session> {
    return this.rest.json('get', '/api/v1/sessions/{id}', { path: { id } }) as Promise<Session>;
  }
  score(id: string): Promise<Score> {
    return this.rest.json('get', '/api/v1/sessions/{id}/score', { path: { id } });
  }
  scoreUrl(id: string): string {
    return this.rest.url('/api/v1/sessions/{id}/score', { path: { id } });
  }
  meshUrl(id: string): string {
    return this.rest.url('/api/v1/sessions/{id}/mesh', { path: { id } });
  }
  jobsUrl(): string {
    return `${this.rest.url('/api/v1/jobs')}/`;
  }
  async trace(id: string, stride: number): Promise<string> {
    const place = { path: { id }, query: { stride } };
    return (await this.rest.request('get', '/api/v1/sessions/{id}/trace', place)).text();
  }
  async annotations(id: string): Promise<Annotation[]> {
    return (await this.rest.json('get', '/api/v1/sessions/{id}/annotations', { path: { id } })).annotations;
  }
  annotate(id: string, text: string, atS: number): Promise<Annotation> {
    const body = { words: text, at_s: atS };
    return this.rest.json('post', '/api/v1/sessions/{id}/annotations', { path: { id }, body });
  }

  /** Waits until it is made; throws ApiError 404 where there is nothing to compare the surface with. */
  async deviation(id: string, to: MapName, onProgress: OnProgress, signal: AbortSignal): Promise<DeviationBytes> {
    const get = () =>
      this.rest.request('get', '/api/v1/sessions/{id}/deviation', { path: { id }, query: { to }, signal });
    const response = await fetchOnceReady(get, this.job, onProgress, signal);
    const header = (name: string) => Number(response.headers.get(name) ?? NaN);
    const bytes = new Int8Array(await response.arrayBuffer());
    const code = {
      stepMm: header('deviation-step-mm'),
      rangeMm: header('deviation-range-mm'),
      unknown: header('deviation-unknown'),
    };
    if (bytes.length !== header('deviation-vertices') || Object.values(code).some((value) => !Number.isFinite(value)))
      throw new Error(problemText.mapUnexplained);
    return { bytes, code };
  }

  /** Makes a file of a session; where it is when it is done. */
  async exported(id: string, format: ExportFormat | 'causes', onProgress: OnProgress): Promise<string> {
    const body = format === 'load' ? { format: 'pdf', component_load: true } : { format };
    const begun = await this.rest.json('post', '/api/v1/sessions/{id}/exports', { path: { id }, body });
    const done = await waitForJob(begun, this.job, onProgress);
    return this.rest.url('/api/v1/jobs/{id}/result', { path: { id: done.id } });
  }

  private readonly job = (id: string) => this.rest.json('get', '/api/v1/jobs/{id}', { path: { id } });
}
