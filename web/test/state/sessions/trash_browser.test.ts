import { expect, it } from 'vitest';

import { TrashBrowser } from '../../../src/state/sessions/trash_browser';
import type { DeletedSession } from '../../../src/wire/trash_api';
import type { Session } from '../../../src/wire/rest_types';

/** One deleted session a page. */
function trashOf(ids: string[]): TrashBrowser {
  const deleted = (id: string): DeletedSession => ({
    id,
    deleted_utc: '2026-11-27T12:00:00Z',
    ends_utc: '2026-12-27T12:00:00Z',
    session: null,
  });
  return new TrashBrowser({
    page: (cursor) => {
      const from = cursor === null ? 0 : Number(cursor);
      const next = from + 1 < ids.length ? String(from + 1) : null;
      return Promise.resolve({ deleted: ids.slice(from, from + 1).map(deleted), next, total: ids.length });
    },
    restore: (id) => {
      if (!ids.includes(id)) return Promise.reject(new Error('not there'));
      ids.splice(ids.indexOf(id), 1);
      return Promise.resolve({ id } as Session);
    },
  });
}

const shown = (trash: TrashBrowser) => trash.page.value.value?.deleted.map(({ id }) => id);

it('restores, says so, and leaves a page that has become empty', async () => {
  const trash = trashOf(['a', 'b']);
  await trash.page.read();
  expect(shown(trash)).toEqual(['a']);
  await trash.next();
  expect(shown(trash)).toEqual(['b']);
  await trash.restore('b');
  expect([shown(trash), trash.restored.value]).toEqual([['a'], 'b']);
  await trash.restore('x');
  expect(trash.restored.value).toBeNull();
  expect(trash.page.problem.value).not.toBeNull();
  await trash.restore('a');
  expect([shown(trash), trash.page.value.value?.total]).toEqual([[], 0]);
});
