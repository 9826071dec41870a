import '../styles/pages.css';

import { useEffect } from 'preact/hooks';

import { Button } from '../panels/common/button';
import { Message } from '../panels/common/fields';
import { Choice, TextLine } from '../panels/common/form_fields';
import { PageHeader } from '../panels/common/page_header';
import { AuditLog, csvOf } from '../state/access/audit_log';
import { appText } from '../text/app_text';
import { auditText } from '../text/audit_text';
import { dayAndTime } from '../text/format';
import { AuditApi, type AuditEntry } from '../wire/audit_api';
import { accountRoles } from '../wire/rest_types';
import { saveBlob } from '../wire/save_blob';

const wordsOf = (action: string) => auditText.actions[action] ?? auditText.unlisted(action);
const log = new AuditLog(new AuditApi(window.location.origin), wordsOf);

/** Who changed or read what, and when; for operators. */
export function AuditPage() {
  useEffect(() => void log.readNewest(), []);
  const entries = log.entries.value;
  const shown = log.shown.value;
  const problem = log.problem.value;
  return (
    <div class="page content-page">
      <PageHeader here="audit" />
      <main class="content">
        <section class="content-panel" aria-labelledby="audit-title" data-testid="audit">
          <div class="content-head">
            <h2 id="audit-title">{auditText.title}</h2>
            {entries !== null && (
              <span class="soft content-count" role="status" data-testid="audit-count">
                {auditText.count(shown.length, entries.length)}
              </span>
            )}
          </div>
          <p class="soft">{auditText.hint}</p>
          <Search />
          {problem !== null && (
            <Message kind="bad" testId="audit-problem">
              {problem}
            </Message>
          )}
          {entries === null && problem === null && <p class="soft">{auditText.loading}</p>}
          {entries !== null && shown.length === 0 && (
            <p class="soft" data-testid="audit-empty">
              {entries.length === 0 ? auditText.none : auditText.noneFits}
            </p>
          )}
          {shown.length > 0 && <Entries entries={shown} />}
          {entries !== null && entries.length > 0 && <Older />}
        </section>
      </main>
    </div>
  );
}

function Search() {
  return (
    <form class="content-form filters" role="search" onSubmit={(event) => event.preventDefault()}>
      <TextLine
        {...{ label: auditText.search, placeholder: auditText.searchHint, testId: 'audit-search', type: 'search' }}
        value={log.text.value}
        onInput={(typed) => (log.text.value = typed)}
      />
      <Choice
        {...{ label: auditText.kind, testId: 'audit-action', value: log.action.value }}
        options={[['', auditText.anyKind], ...log.actions.value.map((action) => [action, wordsOf(action)] as const)]}
        onChange={(action) => (log.action.value = action)}
      />
      <Button testId="audit-newest" disabled={log.busy.value} onClick={() => void log.readNewest()}>
        {auditText.newer}
      </Button>
      <Button
        testId="audit-csv"
        title={auditText.exportHint}
        disabled={log.shown.value.length === 0}
        onClick={() =>
          saveBlob(new Blob([csvOf(auditText.csvColumns, log.shown.value)], { type: 'text/csv' }), 'ream-audit.csv')
        }
      >
        {auditText.export}
      </Button>
    </form>
  );
}

function Entries({ entries }: { entries: readonly AuditEntry[] }) {
  const { whenColumn, whoColumn, whatColumn, objectColumn, detailColumn, fromColumn } = auditText;
  return (
    <div class="table-scroll">
      <table class="data-table">
        <thead>
          <tr>
            {[whenColumn, whoColumn, whatColumn, objectColumn, detailColumn, fromColumn].map((name) => (
              <th key={name} scope="col">
                {name}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {entries.map((entry) => (
            <tr key={entry.number} data-testid={`audit-${entry.number}`}>
              <td class="when">{dayAndTime(entry.at_utc)}</td>
              <td>
                {entry.name || entry.user_id || auditText.nobody} <span class="soft">{roleWord(entry.role)}</span>
              </td>
              <td>{wordsOf(entry.action)}</td>
              <td class="when">{entry.object}</td>
              <td class="words">{entry.detail}</td>
              <td class="when">{entry.address || auditText.commandLine}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/** What the log calls "retention" and the like is no role of a user. */
function roleWord(role: string): string {
  const known = accountRoles.find((one) => one === role);
  return known === undefined ? '' : appText.roles[known];
}

function Older() {
  if (!log.hasOlder.value) return <p class="soft">{auditText.noOlder}</p>;
  return (
    <p class="content-form">
      <Button testId="audit-older" disabled={log.busy.value} onClick={() => void log.readOlder()}>
        {auditText.older}
      </Button>
    </p>
  );
}
