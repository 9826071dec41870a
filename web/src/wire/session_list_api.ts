import type { Session } from './api';
import type { SessionState } from './messages';
import { type Method, request, requestJson } from './rest';

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

export interface SessionPage {
  sessions: Session[];
  /** Cursor of the next page; null: there is none. */
  next: string | null;
  /** On all pages. */
  total: number;
}

/** What of a session people may change; what is absent stays as it is. */
export interface SessionChange {
  title?: string;
}

/** The query of a page's address, without a cursor for the first page. */
export function queryText(query: SessionQuery, cursor: string | null, limit: number): string {
  const parameters = new URLSearchParams({ limit: String(limit), sort: (query.descending ? '-' : '') + query.sort });
  const add = (name: string, value: string) => {
    if (value !== '') parameters.set(name, value);
  };
  add('q', query.text.trim());
  add('state', query.states.join(','));
  add('case', query.caseId);
  add('study', query.study);
  add('from', query.from);
  add('to', dayAfter(query.to));
  add('cursor', cursor ?? '');
  return parameters.toString();
}

/** The last day counts in; the server takes the first moment that does not. */
function dayAfter(day: string): string {
  const ms = Date.parse(`${day}T00:00:00Z`);
  return Number.isNaN(ms) ? '' : new Date(ms + 86_400_000).toISOString().slice(0, 10);
}

/** Calls of the REST interface about sessions of all times; `base` is the server's origin. */
export class SessionListApi {
  constructor(private readonly base: string) {}

  page(query: SessionQuery, cursor: string | null, limit: number): Promise<SessionPage> {
    return this.call('GET', `?${queryText(query, cursor, limit)}`);
  }
  change(id: string, change: SessionChange): Promise<Session> {
    return this.call('PATCH', `/${encodeURIComponent(id)}`, change);
  }
  async remove(id: string): Promise<void> {
    await request(this.url(`/${encodeURIComponent(id)}`), 'DELETE');
  }
  restore(id: string): Promise<Session> {
    return this.call('POST', `/${encodeURIComponent(id)}/restore`);
  }

  private url(path: string): string {
    return `${this.base}/api/v1/sessions${path}`;
  }
  private call<T>(method: Method, path: string, body?: object): Promise<T> {
    return requestJson(this.url(path), method, { body });
  }
}
