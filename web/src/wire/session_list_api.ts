import { RestClient } from './rest_client';
import type { Session, SessionChange, SessionPage } from './rest_types';
import type { SessionState } from './messages';

export type SortKey = 'created_utc' | 'duration_s' | 'case' | 'trainee' | 'state';

/** Which sessions are wanted, and in which order; empty texts and lists let everything pass. */
export interface SessionQuery {
  text: string;
  states: readonly SessionState[];
  caseId: string;
  study: string;
  /** Days as "2026-01-31". */
  from: string;
  to: string;
  sort: SortKey;
  descending: boolean;
}

/** The query of a page, without a cursor for the first page. */
export function queryOf(query: SessionQuery, cursor: string | null, limit: number) {
  const set = (text: string) => (text === '' ? undefined : text);
  const sort = `${query.descending ? '-' : ''}${query.sort}` as const;
  return {
    limit,
    sort,
    q: set(query.text.trim()),
    state: set(query.states.join(',')),
    case: set(query.caseId),
    study: set(query.study),
    from: set(query.from),
    to: set(dayAfter(query.to)),
    cursor: cursor ?? undefined,
  };
}

/** The last day counts in; the server takes the first moment that does not. */
function dayAfter(day: string): string {
  const ms = Date.parse(`${day}T00:00:00Z`);
  return Number.isNaN(ms) ? '' : new Date(ms + 86_400_000).toISOString().slice(0, 10);
}

/** Calls of the REST interface about sessions of all times; `base` is the server's origin. */
export class SessionListApi {
  private readonly rest: RestClient;

  constructor(base: string) {
    this.rest = new RestClient(base);
  }

  page(query: SessionQuery, cursor: string | null, limit: number): Promise<SessionPage> {
    return this.rest.json('get', '/api/v1/sessions', { query: queryOf(query, cursor, limit) });
  }
  change(id: string, body: SessionChange): Promise<Session> {
    return this.rest.json('patch', '/api/v1/sessions/{id}', { path: { id }, body });
  }
  async remove(id: string): Promise<void> {
    await this.rest.request('delete', '/api/v1/sessions/{id}', { path: { id } });
  }
  restore(id: string): Promise<Session> {
    return this.rest.json('post', '/api/v1/sessions/{id}/restore', { path: { id } });
  }
}
