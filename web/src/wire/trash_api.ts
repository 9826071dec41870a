import type { DeletedSession, DeletedSessionList, Session } from './generated/openapi';
import { RestClient } from './rest_client';

export type { DeletedSession, DeletedSessionList };

/** Deleted sessions, and their way back; `base` is the server's origin. */
export class TrashApi {
  private readonly rest: RestClient;

  constructor(base: string) {
    this.rest = new RestClient(base);
  }

  page(cursor: string | null, limit: number): Promise<DeletedSessionList> {
    return this.rest.json('get', '/api/v1/trash', { query: { limit, cursor: cursor ?? undefined } });
  }
  restore(id: string): Promise<Session> {
    return this.rest.json('post', '/api/v1/sessions/{id}/restore', { path: { id } });
  }
}
