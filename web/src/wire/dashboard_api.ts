import { ApiError } from './rest';
import { RestClient } from './rest_client';
import type { Learning, Metrics, Session } from './rest_types';

/** Whose learning; the user's own where neither is named. */
export interface Learner {
  trainee?: string;
  /** Code under which a study knows somebody. */
  participant?: string;
}

/** Pictures are drawn when nothing else needs the server's processors. */
const pictureWithinMs = 90_000;

/** Calls of the REST interface that the dashboard makes; `base` is the server's origin. */
export class DashboardApi {
  private readonly rest: RestClient;

  constructor(base: string) {
    this.rest = new RestClient(base);
  }

  live(): Promise<Session[]> {
    return this.list('running,paused', 60);
  }
  ended(limit: number): Promise<Session[]> {
    return this.list('finished,stopped,fault,interrupted', limit);
  }
  /** Of a session that is under way. */
  soFar(id: string): Promise<Metrics> {
    return this.rest.json('get', '/api/v1/sessions/{id}/metrics', { path: { id } });
  }
  /** The bone as it is now. */
  async picture(id: string): Promise<Blob> {
    const wait = { timeoutMs: pictureWithinMs };
    const response = await this.rest.request('get', '/api/v1/sessions/{id}/snapshot', { path: { id }, ...wait });
    if (response.status !== 200) throw new ApiError(response.statusText, response.status);
    return response.blob();
  }
  /** Null for a case without a plan. */
  async plannedDepthMm(caseId: string): Promise<number | null> {
    try {
      return (await this.rest.json('get', '/api/v1/cases/{id}/plan', { path: { id: caseId } })).depth_mm;
    } catch (error) {
      if (error instanceof ApiError && error.status === 404) return null;
      throw error;
    }
  }
  learning({ trainee, participant }: Learner): Promise<Learning> {
    const query = trainee !== undefined ? { trainee } : { participant };
    return this.rest.json('get', '/api/v1/learning', { query });
  }

  private async list(state: string, limit: number): Promise<Session[]> {
    const query = { sort: '-created_utc', state, limit } as const;
    return (await this.rest.json('get', '/api/v1/sessions', { query })).sessions;
  }
}
