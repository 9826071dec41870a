import { credentials } from './rest';
import { RestClient } from './rest_client';
import type {
  AssessedPlan,
  BuildSettings,
  Case,
  CaseSummary,
  Job,
  Landmarks,
  Measures,
  NewCase,
  NewPlan,
  PlanPrediction,
  PlanTargets,
  Reamer,
  SegmentationSettings,
  Side,
  Upload,
} from './rest_types';

/** A voxel axis of the CT, and the slices across it. */
export type VoxelAxis = 'u' | 'v' | 'w';

/** Calls of the REST interface that make cases of CTs; `base` is the server's origin. */
export class CaseApi {
  private readonly rest: RestClient;

  constructor(base: string) {
    this.rest = new RestClient(base);
  }

  /** All of them, page by page. */
  async cases(): Promise<CaseSummary[]> {
    const all: CaseSummary[] = [];
    for (let cursor: string | null | undefined; cursor !== null;) {
      const query: { limit: number; cursor?: string } = { limit: 500, cursor };
      const page = await this.rest.json('get', '/api/v1/cases', { query });
      all.push(...page.cases);
      cursor = page.next;
    }
    return all;
  }
  case(id: string): Promise<Case> {
    return this.rest.json('get', '/api/v1/cases/{id}', { path: { id } });
  }
  async remove(id: string): Promise<void> {
    await this.rest.request('delete', '/api/v1/cases/{id}', { path: { id } });
  }

  beginUpload(name: string, bytes: number): Promise<Upload> {
    return this.rest.json('post', '/api/v1/uploads', { body: { name, bytes } });
  }
  upload(id: string): Promise<Upload> {
    return this.rest.json('get', '/api/v1/uploads/{id}', { path: { id } });
  }
  sendPiece(id: string, offset: number, body: Uint8Array<ArrayBuffer>, signal: AbortSignal): Promise<Upload> {
    return this.rest.json('put', '/api/v1/uploads/{id}', { path: { id }, query: { offset }, body, signal });
  }
  async dropUpload(id: string): Promise<void> {
    await this.rest.request('delete', '/api/v1/uploads/{id}', { path: { id } });
  }

  importCase(body: NewCase): Promise<Job> {
    return this.rest.json('post', '/api/v1/cases', { body });
  }
  copyCase(copyOf: string, side: Side): Promise<Job> {
    return this.rest.json('post', '/api/v1/cases', { body: { copy_of: copyOf, side } });
  }
  job(id: string): Promise<Job> {
    return this.rest.json('get', '/api/v1/jobs/{id}', { path: { id } });
  }
  async jobs(caseId: string): Promise<Job[]> {
    return (await this.rest.json('get', '/api/v1/jobs', { query: { case_id: caseId } })).jobs;
  }
  cancel(jobId: string): Promise<Job> {
    return this.rest.json('delete', '/api/v1/jobs/{id}', { path: { id: jobId } });
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
    const place = { path: { id, axis, index }, query: { of, revision } };
    return (
      await this.rest.request('get', '/api/v1/cases/{id}/volume/slices/{axis}/{index}', { ...place, signal })
    ).arrayBuffer();
  }
  meshUrl(id: string): string {
    return this.rest.url('/api/v1/cases/{id}/mesh', { path: { id } });
  }

  segment(id: string, body: SegmentationSettings): Promise<Job> {
    return this.rest.json('post', '/api/v1/cases/{id}/segmentation', { path: { id }, body });
  }
  undoSegmentation(id: string): Promise<Case> {
    return this.rest.json('post', '/api/v1/cases/{id}/segmentation/undo', { path: { id } });
  }
  putLandmarks(id: string, body: Landmarks): Promise<Case> {
    return this.rest.json('put', '/api/v1/cases/{id}/landmarks', { path: { id }, body });
  }
  measures(id: string): Promise<Measures> {
    return this.rest.json('get', '/api/v1/cases/{id}/measures', { path: { id } });
  }
  proposePlan(id: string, body: PlanTargets): Promise<AssessedPlan> {
    return this.rest.json('post', '/api/v1/cases/{id}/plan/proposal', { path: { id }, body });
  }
  putPlan(id: string, body: NewPlan): Promise<AssessedPlan> {
    return this.rest.json('put', '/api/v1/cases/{id}/plan', { path: { id }, body });
  }
  assessPlan(id: string, body: NewPlan): Promise<PlanPrediction> {
    return this.rest.json('post', '/api/v1/cases/{id}/plan/assessment', { path: { id }, body });
  }
  async reamers(): Promise<Reamer[]> {
    return (await this.rest.json('get', '/api/v1/reamers', {})).reamers;
  }
  build(id: string, body: BuildSettings): Promise<Job> {
    return this.rest.json('post', '/api/v1/cases/{id}/build', { path: { id }, body });
  }
  /** Sends what must not be lost although the page goes away now. */
  putLandmarksOnLeaving(id: string, landmarks: Landmarks): void {
    void fetch(this.rest.url('/api/v1/cases/{id}/landmarks', { path: { id } }), {
      method: 'PUT',
      keepalive: true,
      headers: { 'content-type': 'application/json', ...credentials.headers() },
      body: JSON.stringify(landmarks),
    }).catch(() => undefined);
  }
}
