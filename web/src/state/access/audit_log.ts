import { batch, computed, signal } from '@preact/signals';

import { messageOf } from '../../wire/rest';
import type { AuditApi, AuditEntry } from '../../wire/audit_api';

const pageSize = 100;

/** The audit log from its newest entry on, as far as it was loaded; searched here, as the server pages only. */
export class AuditLog {
  readonly entries = signal<readonly AuditEntry[] | null>(null);
  readonly problem = signal<string | null>(null);
  readonly busy = signal(false);
  readonly text = signal('');
  /** An action such as "user.add"; empty: all. */
  readonly action = signal('');
  /** There are entries that were not loaded. */
  readonly hasOlder = computed(() => this.next.value !== null);
  private readonly next = signal<number | null>(null);

  readonly actions = computed(() => [...new Set((this.entries.value ?? []).map(({ action }) => action))].sort());

  constructor(
    private readonly api: Pick<AuditApi, 'page'>,
    /** What an action is called; it is searched, too. */
    readonly nameOf: (action: string) => string,
  ) {}

  readonly shown = computed(() => {
    const sought = this.text.value.trim().toLowerCase();
    const wanted = this.action.value;
    return (this.entries.value ?? []).filter(
      (entry) => (wanted === '' || entry.action === wanted) && this.wordsOf(entry).includes(sought),
    );
  });

  readNewest(): Promise<void> {
    return this.read(null);
  }

  async readOlder(): Promise<void> {
    if (this.next.value !== null) await this.read(this.next.value);
  }

  private async read(before: number | null): Promise<void> {
    if (this.busy.value) return;
    this.busy.value = true;
    try {
      const page = await this.api.page(pageSize, before);
      batch(() => {
        this.entries.value = [...(before === null ? [] : (this.entries.value ?? [])), ...page.entries];
        this.next.value = page.next;
        this.problem.value = null;
      });
    } catch (error) {
      this.problem.value = messageOf(error);
    } finally {
      this.busy.value = false;
    }
  }

  private wordsOf({ name, user_id: user, role, address, action, object, detail }: AuditEntry): string {
    return [name, user, role, address, action, this.nameOf(action), object, detail].join('\n').toLowerCase();
  }
}

/** Rows of a CSV file, RFC 4180; what a spreadsheet would take for a formula is kept a text. */
export function csvOf<Row extends object>(columns: readonly (keyof Row & string)[], rows: readonly Row[]): string {
  const cell = (value: unknown) => {
    const text = typeof value === 'string' ? value : JSON.stringify(value ?? '');
    const safe = /^[=+\-@\t\r]/.test(text) && typeof value === 'string' ? `'${text}` : text;
    return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
  };
  return [columns, ...rows.map((row) => columns.map((key) => row[key]))]
    .map((line) => line.map(cell).join(',') + '\r\n')
    .join('');
}
