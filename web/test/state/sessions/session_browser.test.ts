import { beforeEach, describe, expect, it } from 'vitest';

import { everything, SessionBrowser } from '../../../src/state/sessions/session_browser';
import type { Session, SessionPage } from '../../../src/wire/rest_types';
import { ApiError } from '../../../src/wire/rest';
import { queryOf, type SessionListApi, type SessionQuery } from '../../../src/wire/session_list_api';

const session = (id: string) => ({ id }) as Session;

class FakeList {
  requests: string[] = [];
  all = ['a', 'b', 'c'];
  fails: ApiError | null = null;

  page = (query: SessionQuery, cursor: string | null): Promise<SessionPage> => {
    this.requests.push(`${query.text}|${query.descending ? '-' : ''}${query.sort}|${cursor ?? ''}`);
    const at = cursor === null ? 0 : Number(cursor);
    const next = at + 1 < this.all.length ? String(at + 1) : null;
    return Promise.resolve({ sessions: [session(this.all[at] ?? '')], next, total: this.all.length });
  };
  private update(): Promise<Session> {
    return this.fails === null ? Promise.resolve(session('x')) : Promise.reject(this.fails);
  }
  change = () => this.update();
  remove = () => this.update().then(() => undefined);
  restore = () => this.update();
}

describe('SessionBrowser', () => {
  let list: FakeList;
  let browser: SessionBrowser;
  const shown = () => browser.page.value.value?.sessions.map((one) => one.id);

  beforeEach(async () => {
    list = new FakeList();
    browser = new SessionBrowser(list as unknown as SessionListApi);
    await browser.page.read();
  });

  it('turns pages forth and back', async () => {
    expect(shown()).toEqual(['a']);
    await browser.next();
    await browser.next();
    expect(shown()).toEqual(['c']);
    await browser.next();
    expect(shown()).toEqual(['c']);
    await browser.previous();
    expect(shown()).toEqual(['b']);
    await browser.previous();
    await browser.previous();
    expect(shown()).toEqual(['a']);
  });

  it('says whether filters hold anything back; an order does not', async () => {
    await browser.sortBy('case');
    expect(browser.filtered.value).toBe(false);
    await browser.show({ states: ['paused'] });
    expect(browser.filtered.value).toBe(true);
    await browser.show({ states: [] });
    expect(browser.filtered.value).toBe(false);
  });

  it('begins at the first page with other filters or another order', async () => {
    await browser.next();
    await browser.show({ text: 'slab' });
    expect(list.requests.at(-1)).toBe('slab|-created_utc|');
    await browser.next();
    await browser.sortBy('trainee');
    expect(list.requests.at(-1)).toBe('slab|trainee|');
    await browser.sortBy('trainee');
    expect(list.requests.at(-1)).toBe('slab|-trainee|');
    await browser.sortBy('created_utc');
    expect(list.requests.at(-1)).toBe('slab|-created_utc|');
  });

  it('says what could not be done, and offers to take a deletion back', async () => {
    list.fails = new ApiError('it is still running', 409);
    await browser.remove(session('a'));
    expect(browser.page.problem.value).toBe('it is still running');
    expect(browser.deleted.value).toBeNull();
    list.fails = null;
    await browser.remove(session('a'));
    expect(browser.deleted.value?.id).toBe('a');
    await browser.restore();
    expect(browser.deleted.value).toBeNull();
    expect(await browser.change('a', { title: 'x' })).toBe(true);
  });
});

describe('queryOf', () => {
  it('leaves out what lets everything pass, and counts the last day in', () => {
    expect(Object.entries(queryOf(everything, null, 25)).filter(([, value]) => value !== undefined)).toEqual([
      ['limit', 25],
      ['sort', '-created_utc'],
    ]);
    const query = {
      ...everything,
      text: ' a&b ',
      states: ['running', 'paused'] as const,
      from: '2026-01-01',
      to: '2026-01-31',
    };
    expect(queryOf(query, 'c', 10)).toEqual({
      limit: 10,
      sort: '-created_utc',
      q: 'a&b',
      state: 'running,paused',
      from: '2026-01-01',
      to: '2026-02-01',
      cursor: 'c',
      case: undefined,
      study: undefined,
    });
  });
});
