import { RestClient } from './rest_client';
import type { Metrics, PlaybackChange, Replay, Session } from './rest_types';

export { ApiError } from './rest';

type EarlierInStudy = { study: string; participant: string; created_utc: string };

/** Calls of the REST interface about what is watched; `base` is the server's origin. */
export class Api {
  private readonly rest: RestClient;

  constructor(base: string) {
    this.rest = new RestClient(base);
  }

  async sessions(): Promise<Session[]> {
    return (await this.rest.json('get', '/api/v1/sessions', {})).sessions;
  }
  createDemo(): Promise<Session> {
    return this.rest.json('post', '/api/v1/sessions', { body: { case: 'demo', script: 'demo', device: 'script' } });
  }
  /** A session on a case that waits for a hand in a browser. */
  createPractice(caseId: string, theatre: boolean): Promise<Session> {
    const body = { case: caseId, device: 'browser', ...(theatre ? { theatre } : {}) };
    return this.rest.json('post', '/api/v1/sessions', { body });
  }
  /** A session of a study; participant null: the user; an empty `caseId`: the study knows which one is next. */
  createInStudy(study: string, participant: string | null, caseId: string): Promise<Session> {
    const body = {
      study,
      ...(caseId === '' ? {} : { case: caseId }),
      ...(participant === null ? {} : { participant }),
    };
    return this.rest.json('post', '/api/v1/sessions', { body });
  }
  /** How many sessions of its study its participant had before it. */
  async earlierInStudy({ study, participant, created_utc }: EarlierInStudy): Promise<number> {
    // The server takes whole seconds.
    const to = `${created_utc.slice(0, 19)}Z`;
    return (await this.rest.json('get', '/api/v1/sessions', { query: { study, participant, to, limit: 1 } })).total;
  }
  /** Throws, in the server's words, while it still prepares for sessions. */
  async ready(): Promise<void> {
    await this.rest.request('get', '/readyz', {});
  }
  /** Of a session, not of a replay. */
  session(id: string): Promise<Session> {
    return this.rest.json('get', '/api/v1/sessions/{id}', { path: { id } }) as Promise<Session>;
  }
  start(id: string): Promise<Session> {
    return this.rest.json('post', '/api/v1/sessions/{id}/start', { path: { id } });
  }
  stop(id: string): Promise<Session> {
    return this.rest.json('post', '/api/v1/sessions/{id}/stop', { path: { id } }) as Promise<Session>;
  }
  pause(id: string): Promise<Session> {
    return this.rest.json('post', '/api/v1/sessions/{id}/pause', { path: { id } });
  }
  /** Another session of the same kind on intact bone; the one before ends. */
  reset(id: string): Promise<Session> {
    return this.rest.json('post', '/api/v1/sessions/{id}/reset', { path: { id } });
  }
  openReplay(sessionId: string): Promise<Replay> {
    return this.rest.json('post', '/api/v1/sessions/{id}/replay', { path: { id: sessionId } });
  }
  replay(id: string): Promise<Replay> {
    return this.rest.json('get', '/api/v1/sessions/{id}', { path: { id } }) as Promise<Replay>;
  }
  changePlayback(id: string, body: PlaybackChange): Promise<Replay> {
    return this.rest.json('post', '/api/v1/sessions/{id}/playback', { path: { id }, body });
  }
  metrics(id: string): Promise<Metrics> {
    return this.rest.json('get', '/api/v1/sessions/{id}/metrics', { path: { id } });
  }
  streamUrl(id: string): string {
    return this.rest.url('/api/v1/sessions/{id}/stream', { path: { id } }).replace(/^http/, 'ws');
  }
  deviceUrl(id: string): string {
    return this.rest.url('/api/v1/sessions/{id}/device', { path: { id } }).replace(/^http/, 'ws');
  }
}
