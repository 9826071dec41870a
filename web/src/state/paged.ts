import { signal } from '@preact/signals';

import { Remote } from './remote';

/** A long list of the server's, page by page; each page says by its cursor where the next one begins. */
export class Paged<Page extends { next: string | null }> {
  readonly page: Remote<Page>;
  /** Cursors of the pages up to the one that is shown; the first page has none. */
  readonly cursors = signal<readonly (string | null)[]>([null]);

  constructor(load: (cursor: string | null) => Promise<Page>) {
    this.page = new Remote(() => load(this.cursors.value.at(-1) ?? null));
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
}
