import '../styles/pages.css';

import { useEffect } from 'preact/hooks';

import { ActionsColumn } from '../panels/common/actions_column';
import { Button } from '../panels/common/button';
import { Message } from '../panels/common/fields';
import { PageButtons } from '../panels/common/page_buttons';
import { PageHeader } from '../panels/common/page_header';
import { addressOfRoute } from '../state/route';
import { TrashBrowser } from '../state/sessions/trash_browser';
import { dayAndTime, dayYearAndTime, duration } from '../text/format';
import { trashText } from '../text/trash_text';
import { type DeletedSession, TrashApi } from '../wire/trash_api';

const trash = new TrashBrowser(new TrashApi(window.location.origin));

/** Sessions that were deleted and can still be restored. */
export function TrashPage() {
  useEffect(() => {
    trash.restored.value = null;
    void trash.page.read();
  }, []);
  const page = trash.page.value.value;
  const problem = trash.page.problem.value;
  return (
    <div class="page content-page">
      <PageHeader here="sessions" />
      <main class="content">
        <section class="content-panel" aria-labelledby="trash-title" data-testid="trash">
          <p>
            <a href={addressOfRoute({ kind: 'sessions' })}>‹ {trashText.back}</a>
          </p>
          <div class="content-head">
            <h2 id="trash-title">{trashText.title}</h2>
            {page !== null && (
              <span class="soft content-count" role="status" data-testid="trash-count">
                {trashText.count(page.total)}
              </span>
            )}
          </div>
          <p class="soft">{trashText.hint}</p>
          {problem !== null && (
            <Message kind="bad" testId="trash-problem">
              {problem}
            </Message>
          )}
          <Restored />
          {page === null && problem === null && <p class="soft">{trashText.loading}</p>}
          {page?.deleted.length === 0 && (
            <p class="soft" data-testid="trash-empty">
              {trashText.none}
            </p>
          )}
          {page !== null && page.deleted.length > 0 && <DeletedTable deleted={page.deleted} />}
          <PageButtons list={trash} />
        </section>
      </main>
    </div>
  );
}

function Restored() {
  const id = trash.restored.value;
  return (
    <div role="status">
      {id !== null && (
        <Message kind="soft" testId="restored">
          {trashText.restored(id)} <a href={addressOfRoute({ kind: 'sessions' })}>{trashText.back}</a>
        </Message>
      )}
    </div>
  );
}

function DeletedTable({ deleted }: { deleted: readonly DeletedSession[] }) {
  return (
    <div class="table-scroll">
      <table class={trash.page.stale.value ? 'data-table stale' : 'data-table'}>
        <thead>
          <tr>
            {[
              trashText.deletedColumn,
              trashText.untilColumn,
              trashText.titleColumn,
              trashText.whenColumn,
              trashText.caseColumn,
              trashText.traineeColumn,
            ].map((name) => (
              <th key={name} scope="col">
                {name}
              </th>
            ))}
            <th scope="col" class="number">
              {trashText.durationColumn}
            </th>
            <ActionsColumn />
          </tr>
        </thead>
        <tbody>
          {deleted.map((one) => (
            <DeletedRow key={one.id} one={one} />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function DeletedRow({ one }: { one: DeletedSession }) {
  const { id, session } = one;
  const name = session?.title || id;
  return (
    <tr data-testid={`deleted-${id}`}>
      <td class="when">{dayAndTime(one.deleted_utc)}</td>
      <td class="when">{dayYearAndTime(one.ends_utc)}</td>
      {session === null ? (
        <td colSpan={5} class="soft">
          {trashText.unreadable(id)}
        </td>
      ) : (
        <>
          <td>{session.title || <span class="soft">{trashText.untitled}</span>}</td>
          <td class="when">{dayAndTime(session.created_utc)}</td>
          <td>{session.case}</td>
          <td>{session.trainee || session.participant}</td>
          <td class="number when">{duration(session.duration_s)}</td>
        </>
      )}
      <td class="actions">
        <Button
          testId={`restore-${id}`}
          label={trashText.restoreOf(name)}
          disabled={trash.page.busy.value}
          onClick={() => void trash.restore(id)}
        >
          {trashText.restore}
        </Button>
      </td>
    </tr>
  );
}
