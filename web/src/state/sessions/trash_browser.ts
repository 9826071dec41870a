import { signal } from '@preact/signals';

import type { DeletedSessionList, TrashApi } from '../../wire/trash_api';
import { Paged } from '../paged';

const pageSize = 25;

/** Pages of the deleted sessions. */
export class TrashBrowser extends Paged<DeletedSessionList> {
  /** The session that was restored last. */
  readonly restored = signal<string | null>(null);

  constructor(private readonly api: Pick<TrashApi, 'page' | 'restore'>) {
    super((cursor) => api.page(cursor, pageSize));
  }

  async restore(id: string): Promise<void> {
    this.restored.value = null;
    if ((await this.page.act(() => this.api.restore(id))) === null) return;
    this.restored.value = id;
    // The last one of a page leaves it empty.
    if (this.page.value.value?.deleted.length === 0) await this.previous();
  }
}
