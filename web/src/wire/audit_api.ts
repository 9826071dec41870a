import type { AuditEntry, AuditPage } from './generated/openapi';
import { RestClient } from './rest_client';

export type { AuditEntry };

/** Reading the audit log; `base` is the server's origin. */
export class AuditApi {
  private readonly rest: RestClient;

  constructor(base: string) {
    this.rest = new RestClient(base);
  }

  /** The newest entries, or those before an entry's number. */
  page(limit: number, before: number | null): Promise<AuditPage> {
    return this.rest.json('get', '/api/v1/audit', { query: { limit, before: before ?? undefined } });
  }
}
