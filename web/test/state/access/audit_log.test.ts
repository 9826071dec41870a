import { describe, expect, it } from 'vitest';

import { AuditLog, csvOf } from '../../../src/state/access/audit_log';
import type { AuditEntry } from '../../../src/wire/audit_api';

const entry = (number: number, action: string, others: Partial<AuditEntry> = {}): AuditEntry => ({
  number,
  at_utc: '2026-11-27T12:00:00Z',
  user_id: 'u1',
  name: 'olga',
  role: 'operator',
  credential: '',
  address: '127.0.0.1',
  action,
  object: `o${number}`,
  detail: '',
  ...others,
});

/** A server with these entries, two a page. */
function logOf(all: readonly AuditEntry[]): { log: AuditLog; asked: (number | null)[] } {
  const asked: (number | null)[] = [];
  const page = (_limit: number, before: number | null) => {
    asked.push(before);
    const older = all.filter(({ number }) => before === null || number < before);
    const entries = older.slice(0, 2);
    return Promise.resolve({ entries, next: older.length > 2 ? (entries.at(-1)?.number ?? null) : null });
  };
  return { log: new AuditLog({ page }, (action) => ({ 'user.add': 'Added a user' })[action] ?? action), asked };
}

const numbers = (log: AuditLog) => log.shown.value.map(({ number }) => number);

describe('the audit log', () => {
  it('is loaded page by page, newest first, and begins anew', async () => {
    const { log, asked } = logOf([5, 4, 3, 2, 1].map((number) => entry(number, 'login')));
    expect(log.entries.value).toBeNull();
    await log.readNewest();
    expect([numbers(log), log.hasOlder.value]).toEqual([[5, 4], true]);
    await log.readOlder();
    await log.readOlder();
    expect([numbers(log), log.hasOlder.value]).toEqual([[5, 4, 3, 2, 1], false]);
    await log.readOlder();
    expect(asked).toEqual([null, 4, 2]);
    await log.readNewest();
    expect(numbers(log)).toEqual([5, 4]);
  });

  it('is searched in the words that are shown, and by action', async () => {
    const { log } = logOf([entry(2, 'user.add', { object: 'tom' }), entry(1, 'login', { name: 'ines' })]);
    await log.readNewest();
    expect(log.actions.value).toEqual(['login', 'user.add']);
    for (const [text, found] of [
      ['ADDED a', [2]],
      [' tom ', [2]],
      ['ines', [1]],
      ['nobody', []],
    ] as const) {
      log.text.value = text;
      expect(numbers(log)).toEqual(found);
    }
    log.text.value = '';
    log.action.value = 'login';
    expect(numbers(log)).toEqual([1]);
  });

  it('says what went wrong, and keeps what it has', async () => {
    let broken = false;
    const page = () =>
      broken ? Promise.reject(new Error('no answer')) : Promise.resolve({ entries: [entry(1, 'login')], next: null });
    const log = new AuditLog({ page }, (action) => action);
    await log.readNewest();
    broken = true;
    await log.readNewest();
    expect([numbers(log), log.busy.value]).toEqual([[1], false]);
    expect(log.problem.value).not.toBeNull();
  });
});

describe('a CSV file', () => {
  it('has a head, quotes what needs it, and no formulas', () => {
    const rows = [
      { n: 1, words: 'a "b", c' },
      { n: -2, words: '=HYPERLINK("x")' },
      { n: 3, words: 'two\nlines' },
    ];
    expect(csvOf(['n', 'words'], rows)).toBe(
      'n,words\r\n1,"a ""b"", c"\r\n-2,"\'=HYPERLINK(""x"")"\r\n3,"two\nlines"\r\n',
    );
  });
});
