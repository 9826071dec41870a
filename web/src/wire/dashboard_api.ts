import type { Outcome, Session } from './api';
import { ApiError, request, requestJson } from './rest';

/** Of a session that is under way: figures so far; more are sent. */
export interface SoFar {
  reaming_depth_mm: number;
  /** Over the time in contact with the spindle on, N. */
  axial_thrust_mean_n: number;
  axial_thrust_peak_n: number;
  /** Integral of thrust beyond 78 N. */
  axial_thrust_excess_n_s?: number;
  removed_volume_mm3: number;
  duration_s: number;
  /** How far pegs would reach through the outer cortex. */
  vault_breach_mm?: number | null;
}

/** What the sums of successes and failures say about somebody. */
export type Standing = 'going on' | 'proficient' | 'not proficient';

/** A trainee's course of learning; sessions in order of time. */
export interface Learning {
  standing: Standing;
  /** Passed sessions in a row that would prove proficiency from here. */
  passes_to_go: number;
  acceptable_rate: number;
  unacceptable_rate: number;
  /** At or below, and at or above, the sum decides. */
  proficient_at: number;
  not_proficient_at: number;
  rubric: { id: string; version: number };
  sessions: LearningSession[];
}

export interface LearningSession {
  session: string;
  created_utc: string;
  theatre: boolean;
  points: number | null;
  outcome: Outcome;
  /** Null where the session was neither passed nor failed. */
  cusum: number | null;
  standing: Standing | null;
}

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
  constructor(private readonly base: string) {}

  live(): Promise<Session[]> {
    return this.list('state=running,paused&limit=60');
  }
  ended(limit: number): Promise<Session[]> {
    return this.list(`state=finished,stopped,fault,interrupted&limit=${limit}`);
  }
  soFar(id: string): Promise<SoFar> {
    return this.get(`sessions/${encodeURIComponent(id)}/metrics`);
  }
  /** The bone as it is now. */
  async picture(id: string): Promise<Blob> {
    const url = `${this.base}/api/v1/sessions/${encodeURIComponent(id)}/snapshot`;
    const response = await request(url, 'GET', { timeoutMs: pictureWithinMs });
    if (response.status !== 200) throw new ApiError(response.statusText, response.status);
    return response.blob();
  }
  /** Null for a case without a plan. */
  async plannedDepthMm(caseId: string): Promise<number | null> {
    try {
      return (await this.get<{ depth_mm: number }>(`cases/${encodeURIComponent(caseId)}/plan`)).depth_mm;
    } catch (error) {
      if (error instanceof ApiError && error.status === 404) return null;
      throw error;
    }
  }
  learning({ trainee, participant }: Learner): Promise<Learning> {
    const of = new URLSearchParams();
    if (trainee !== undefined) of.set('trainee', trainee);
    else if (participant !== undefined) of.set('participant', participant);
    return this.get(`learning?${of.toString()}`);
  }

  private async list(query: string): Promise<Session[]> {
    return (await this.get<{ sessions: Session[] }>(`sessions?sort=-created_utc&${query}`)).sessions;
  }
  private get<T>(path: string): Promise<T> {
    return requestJson(`${this.base}/api/v1/${path}`, 'GET');
  }
}
