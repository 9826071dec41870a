import type {
  AssessedPlan,
  BuildWishes,
  CaseDetails,
  CaseSummary,
  Job,
  Landmarks,
  Measures,
  NewCase,
  Plan,
  PlanWishes,
  Reamer,
  SegmentationSettings,
  Side,
  Upload,
  VoxelAxis,
} from './case_types';
import { type CallOptions, credentials, type Method, request, requestJson } from './rest';

/** Calls of the REST interface that make cases of CTs; `base` is the server's origin. */
export class CaseApi {
  constructor(private readonly base: string) {}

  /** All of them, page by page. */
  async cases(): Promise<CaseSummary[]> {
    const all: CaseSummary[] = [];
    for (let cursor: string | null = ''; cursor !== null;) {
      const after: string = cursor === '' ? '' : `&cursor=${encodeURIComponent(cursor)}`;
      const page = await this.call<{ cases: CaseSummary[]; next?: string | null }>('GET', `cases?limit=500${after}`);
      all.push(...page.cases);
      cursor = page.next ?? null;
    }
    return all;
  }
  case(id: string): Promise<CaseDetails> {
    return this.call('GET', this.path(id));
  }
  async remove(id: string): Promise<void> {
    await request(this.url(this.path(id)), 'DELETE');
  }

  beginUpload(name: string, bytes: number): Promise<Upload> {
    return this.call('POST', 'uploads', { body: { name, bytes } });
  }
  upload(id: string): Promise<Upload> {
    return this.call('GET', `uploads/${encodeURIComponent(id)}`);
  }
  sendPiece(id: string, offset: number, body: Uint8Array<ArrayBuffer>, signal: AbortSignal): Promise<Upload> {
    return this.call('PUT', `uploads/${encodeURIComponent(id)}?offset=${offset}`, { body, signal });
  }
  async dropUpload(id: string): Promise<void> {
    await request(this.url(`uploads/${encodeURIComponent(id)}`), 'DELETE');
  }

  importCase(wanted: NewCase): Promise<Job> {
    return this.call('POST', 'cases', { body: wanted });
  }
  copyCase(copyOf: string, side: Side): Promise<Job> {
    return this.call('POST', 'cases', { body: { copy_of: copyOf, side } });
  }
  job(id: string): Promise<Job> {
    return this.call('GET', `jobs/${encodeURIComponent(id)}`);
  }
  async jobs(caseId: string): Promise<Job[]> {
    return (await this.call<{ jobs: Job[] }>('GET', `jobs?case_id=${encodeURIComponent(caseId)}`)).jobs;
  }
  cancel(jobId: string): Promise<Job> {
    return this.call('DELETE', `jobs/${encodeURIComponent(jobId)}`);
  }

  /**
   * HU as 16-bit or labels as 8-bit numbers, rows as the CT has them. Never from the browser's cache: another case may
   * have had the same id.
   */
  async slice(
    id: string,
    of: 'hu' | 'labels',
    revision: number,
    axis: VoxelAxis,
    index: number,
    signal: AbortSignal,
  ): Promise<ArrayBuffer> {
    const path = `${this.path(id)}/volume/slices/${axis}/${index}?of=${of}&revision=${revision}`;
    return (await request(this.url(path), 'GET', { signal })).arrayBuffer();
  }
  meshUrl(id: string): string {
    return this.url(`${this.path(id)}/mesh`);
  }

  segment(id: string, settings: SegmentationSettings): Promise<Job> {
    return this.call('POST', `${this.path(id)}/segmentation`, { body: settings });
  }
  undoSegmentation(id: string): Promise<CaseDetails> {
    return this.call('POST', `${this.path(id)}/segmentation/undo`);
  }
  putLandmarks(id: string, landmarks: Landmarks): Promise<CaseDetails> {
    return this.call('PUT', `${this.path(id)}/landmarks`, { body: landmarks });
  }
  measures(id: string): Promise<Measures> {
    return this.call('GET', `${this.path(id)}/measures`);
  }
  proposePlan(id: string, wishes: PlanWishes): Promise<AssessedPlan> {
    return this.call('POST', `${this.path(id)}/plan/proposal`, { body: wishes });
  }
  putPlan(id: string, plan: Plan): Promise<AssessedPlan> {
    return this.call('PUT', `${this.path(id)}/plan`, { body: plan });
  }
  async reamers(): Promise<Reamer[]> {
    return (await this.call<{ reamers: Reamer[] }>('GET', 'reamers')).reamers;
  }
  build(id: string, wishes: BuildWishes): Promise<Job> {
    return this.call('POST', `${this.path(id)}/build`, { body: wishes });
  }
  /** Sends what must not be lost although the page goes away now. */
  putLandmarksOnLeaving(id: string, landmarks: Landmarks): void {
    void fetch(this.url(`${this.path(id)}/landmarks`), {
      method: 'PUT',
      keepalive: true,
      headers: { 'content-type': 'application/json', ...credentials.headers() },
      body: JSON.stringify(landmarks),
    }).catch(() => undefined);
  }

  private path(id: string): string {
    return `cases/${encodeURIComponent(id)}`;
  }
  private url(path: string): string {
    return `${this.base}/api/v1/${path}`;
  }
  private call<T>(method: Method, path: string, options: CallOptions = {}): Promise<T> {
    return requestJson(this.url(path), method, options);
  }
}
