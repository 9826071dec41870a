import { signal } from '@preact/signals';

import type { DeletedSessionList, TrashApi } from '../../wire/trash_api';
import { Remote } from '../remote';

const pageSize = 25;

/** Pages of the deleted sessions. */
export class TrashBrowser {
  readonly page: Remote<DeletedSessionList>;
  /** The session that was restored last. */
  readonly restored = signal<string | null>(null);
  /** Cursors of the pages up to the one that is shown; the first page has none. */
  readonly cursors = signal<readonly (string | null)[]>([null]);

  constructor(private readonly api: Pick<TrashApi, 'page' | 'restore'>) {
    this.page = new Remote(() => api.page(this.cursors.value.at(-1) ?? null, pageSize));
  }

  async next(): Promise<void> {
    const next = this.page.value.value?.next ?? null;
    if (next === null) return;
    this.cursors.value = [...this.cursors.value, next];
    await this.page.read();
  }

  async previous(): Promise<void> {
    if (this.cursors.value.length < 2) return;
    this.cursors.value = this.cursors.value.slice(0, -1);
    await this.page.read();
  }

  async restore(id: string): Promise<void> {
    this.restored.value = null;
    if ((await this.page.act(() => this.api.restore(id))) === null) return;
    this.restored.value = id;
    // The last one of a page leaves it empty.
    if (this.page.value.value?.deleted.length === 0) await this.previous();
  }
}
