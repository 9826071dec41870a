import { batch, computed, signal } from '@preact/signals';

import type { Session, SessionChange, SessionPage } from '../../wire/rest_types';
import type { SessionListApi, SessionQuery, SortKey } from '../../wire/session_list_api';
import { Paged } from '../paged';

export const pageSize = 25;

export const everything: SessionQuery = {
  text: '',
  states: [],
  caseId: '',
  study: '',
  from: '',
  to: '',
  sort: 'created_utc',
  descending: true,
};

/** Pages of the sessions that the filters let pass. */
export class SessionBrowser extends Paged<SessionPage> {
  readonly query = signal<SessionQuery>(everything);
  /** The session that was deleted last, as long as that can be undone here. */
  readonly deleted = signal<Session | null>(null);

  /** Not all sessions are wanted. */
  readonly filtered = computed(() => {
    const { sort, descending } = everything;
    return JSON.stringify({ ...this.query.value, sort, descending }) !== JSON.stringify(everything);
  });

  constructor(private readonly api: SessionListApi) {
    super((cursor) => api.page(this.query.value, cursor, pageSize));
  }

  /** Other filters or another order begin at the first page. */
  async show(change: Partial<SessionQuery>): Promise<void> {
    batch(() => {
      this.query.value = { ...this.query.value, ...change };
      this.cursors.value = [null];
      this.page.problem.value = null;
    });
    await this.page.read();
  }

  /** By this key, or by the same key the other way about. */
  async sortBy(sort: SortKey): Promise<void> {
    const { query } = this;
    const same = query.value.sort === sort;
    await this.show({ sort, descending: same ? !query.value.descending : sort === 'created_utc' });
  }

  async change(id: string, change: SessionChange): Promise<boolean> {
    return (await this.page.act(() => this.api.change(id, change))) !== null;
  }

  async remove(session: Session): Promise<void> {
    if ((await this.page.act(() => this.api.remove(session.id))) !== null) this.deleted.value = session;
  }

  async restore(): Promise<void> {
    const session = this.deleted.value;
    if (session === null) return;
    if ((await this.page.act(() => this.api.restore(session.id))) !== null) this.deleted.value = null;
  }
}
