import { pageText } from '../../text/page_text';
import { sessionText } from '../../text/session_text';
import type { SessionBrowser } from '../../state/sessions/session_browser';
import type { Session } from '../../wire/rest_types';
import type { SortKey } from '../../wire/session_list_api';
import { SessionRow } from './session_row';
import { ActionsColumn } from '../common/actions_column';

const columns: readonly (readonly [SortKey | null, string])[] = [
  ['created_utc', sessionText.whenColumn],
  [null, sessionText.titleColumn],
  ['case', sessionText.caseColumn],
  ['trainee', sessionText.traineeColumn],
  ['state', sessionText.stateColumn],
  ['duration_s', sessionText.durationColumn],
];

interface Parts {
  browser: SessionBrowser;
  watch: (session: Session) => void;
  replay: (session: Session) => void;
}

/** A page of sessions, sorted by the column that is pressed. */
export function SessionTable({ browser, watch, replay }: Parts) {
  const { sort, descending } = browser.query.value;
  const sessions = browser.page.value.value?.sessions ?? [];
  return (
    <div class="table-scroll">
      <table class={browser.page.stale.value ? 'data-table stale' : 'data-table'} data-testid="session-table">
        <thead>
          <tr>
            {columns.map(([key, name]) => (
              <th
                key={name}
                scope="col"
                class={key === 'duration_s' ? 'number' : ''}
                aria-sort={key === sort ? (descending ? 'descending' : 'ascending') : undefined}
              >
                {key === null ? (
                  name
                ) : (
                  <button
                    type="button"
                    class="sort-button"
                    data-testid={`sort-${key}`}
                    title={sessionText.sortBy(name)}
                    onClick={() => void browser.sortBy(key)}
                  >
                    {name}
                    <span aria-hidden="true">{key === sort ? (descending ? ' ↓' : ' ↑') : ''}</span>
                  </button>
                )}
              </th>
            ))}
            <th scope="col" class="number">
              {pageText.points}
            </th>
            <th scope="col">{pageText.result}</th>
            <ActionsColumn />
          </tr>
        </thead>
        <tbody>
          {sessions.map((session) => (
            <SessionRow key={session.id} session={session} {...{ browser, watch, replay }} />
          ))}
        </tbody>
      </table>
    </div>
  );
}
