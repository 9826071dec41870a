import { batch, computed, signal } from '@preact/signals';
import Papa from 'papaparse';

import { bulkUsersText } from '../../text/bulk_users_text';
import { ApiError, messageOf } from '../../wire/rest';
import type { NewUser } from '../../wire/rest_types';
import { checkUsers, generatedPassword, isRole, type UserRow } from './user_rows';

type Add = (user: NewUser) => Promise<unknown>;
/** How a line came out; null: it was not tried. */
export type Outcome = { created: true } | { created: false; reason: string } | null;

/** A table of users while it is checked, and while they are made one by one. */
export class BulkUsers {
  readonly text = signal('');
  /** Names of users that there are; set before the text is checked. */
  readonly taken = signal<readonly string[]>([]);
  readonly outcomes = signal<ReadonlyMap<number, Outcome>>(new Map());
  readonly busy = signal(false);
  /** Of users that were made here, until the page is left. */
  readonly generated = signal<readonly { name: string; password: string }[]>([]);

  /** The generated passwords as they were when they were copied. */
  private readonly copied = signal<unknown>(null);
  /** Leaving the page would lose something. */
  readonly unsaved = computed(
    () => this.busy.value || (this.generated.value.length > 0 && this.copied.value !== this.generated.value),
  );

  readonly check = computed(() => checkUsers(this.text.value, this.taken.value));
  readonly faults = computed(() => this.check.value.rows.filter(({ fault }) => fault !== null).length);
  /** Lines whose users are still to be made. */
  readonly open = computed(() =>
    this.check.value.rows.filter((row) => !row.exists && this.outcomes.value.get(row.line)?.created !== true),
  );
  readonly tried = computed(() => this.outcomes.value.size > 0);
  readonly created = computed(() => [...this.outcomes.value.values()].filter((one) => one?.created === true).length);
  readonly failed = computed(() => [...this.outcomes.value.values()].filter((one) => one?.created === false).length);

  /** Of lines that were tried; a lost answer may have made the user with it. */
  private readonly drawn = new Map<number, string>();

  constructor(private readonly password: () => string = () => generatedPassword()) {}

  /** Another table; what came of the one before is forgotten, but not its passwords. */
  write(text: string): void {
    this.drawn.clear();
    batch(() => {
      this.text.value = text;
      this.outcomes.value = new Map();
    });
  }

  noteCopied(): void {
    this.copied.value = this.generated.value;
  }

  /** As a table to be handed on. */
  get passwordTable(): string {
    return Papa.unparse([['name', 'password'], ...this.generated.value.map(({ name, password }) => [name, password])]);
  }

  /** Makes them one by one; a line that fails does not keep the others from being made. */
  async create(add: Add): Promise<void> {
    if (this.busy.value || this.faults.value > 0) return;
    this.busy.value = true;
    for (const row of this.open.value) await this.createOne(row, add);
    this.busy.value = false;
  }

  private passwordOf(line: number): string {
    const password = this.drawn.get(line) ?? this.password();
    this.drawn.set(line, password);
    return password;
  }

  private async createOne(row: UserRow, add: Add): Promise<void> {
    if (!isRole(row.role)) return;
    const { name, role, displayName } = row;
    const password = row.password === '' ? this.passwordOf(row.line) : row.password;
    const triedBefore = this.outcomes.value.get(row.line)?.created === false;
    let outcome: Outcome = { created: true };
    try {
      await add({ name, role, password, ...(displayName === '' ? {} : { display_name: displayName }) });
    } catch (error) {
      const there = triedBefore && error instanceof ApiError && error.status === 409;
      outcome = { created: false, reason: there ? bulkUsersText.thereAfterAll : messageOf(error) };
    }
    batch(() => {
      this.outcomes.value = new Map([...this.outcomes.value, [row.line, outcome]]);
      if (outcome.created && row.password === '') this.generated.value = [...this.generated.value, { name, password }];
    });
  }
}
