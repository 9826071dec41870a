import { useSignal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';

import { BulkUsers } from '../../state/access/bulk_users';
import { isRole, type UserRow } from '../../state/access/user_rows';
import type { Remote } from '../../state/remote';
import { accessText } from '../../text/access_text';
import { appText } from '../../text/app_text';
import { bulkUsersText } from '../../text/bulk_users_text';
import { sentence } from '../../text/format';
import type { AccessApi } from '../../wire/access_api';
import type { User } from '../../wire/rest_types';
import { Button } from '../common/button';
import { ColumnHeads } from '../common/column_heads';
import { CopyButton } from '../common/copy_button';
import { useUnsavedGuard } from '../common/use_unsaved_guard';
import { Message } from '../common/fields';

/** Many users at once, from a table: all lines are checked before the first is made. */
export function BulkUsersPanel({ api, users }: { api: AccessApi; users: Remote<User[]> }) {
  const bulk = useMemo(() => new BulkUsers(), []);
  const list = users.value.value;
  // What is made here is told by its line, not as a name that is taken.
  useEffect(() => {
    if (!bulk.tried.peek()) bulk.taken.value = (list ?? []).map(({ name }) => name);
  }, [bulk, list, bulk.tried.value]);
  useUnsavedGuard(bulk, ({ unsaved }) => unsaved.peek(), bulkUsersText.leave);
  const { rows, fault } = bulk.check.value;
  return (
    <section class="content-panel" aria-labelledby="bulk-title" data-testid="bulk-users">
      <h2 id="bulk-title">{bulkUsersText.title}</h2>
      <p class="soft">
        {bulkUsersText.hint} {bulkUsersText.generatedHint} {accessText.passwordRule}
      </p>
      <TableText bulk={bulk} />
      {fault !== null && (
        <Message kind="bad" testId="bulk-fault">
          {fault}
        </Message>
      )}
      {rows.length > 0 && <Checked bulk={bulk} rows={rows} />}
      {rows.length > 0 && (
        <CreateBar
          bulk={bulk}
          create={async () => {
            await bulk.create((user) => api.addUser(user));
            await users.read();
          }}
        />
      )}
      {bulk.generated.value.length > 0 && !bulk.busy.value && <Passwords bulk={bulk} />}
    </section>
  );
}

function TableText({ bulk }: { bulk: BulkUsers }) {
  const problem = useSignal<string | null>(null);
  const read = async (input: HTMLInputElement) => {
    const file = input.files?.[0];
    if (file === undefined) return;
    problem.value = null;
    try {
      bulk.write(await file.text());
    } catch {
      problem.value = bulkUsersText.notRead;
    }
    // The same file can be chosen again when it was corrected.
    input.value = '';
  };
  return (
    <div class="content-form">
      <label>
        {bulkUsersText.file}
        <input
          type="file"
          accept=".csv,.tsv,.txt,text/csv"
          data-testid="bulk-file"
          disabled={bulk.busy.value}
          onChange={(event) => void read(event.currentTarget)}
        />
      </label>
      {problem.value !== null && <Message kind="bad">{problem.value}</Message>}
      <label class="wide">
        {bulkUsersText.table}
        <textarea
          rows={5}
          spellcheck={false}
          autocapitalize="none"
          placeholder={bulkUsersText.example}
          data-testid="bulk-text"
          disabled={bulk.busy.value}
          value={bulk.text.value}
          onInput={(event) => bulk.write(event.currentTarget.value)}
        />
      </label>
    </div>
  );
}

function Checked({ bulk, rows }: { bulk: BulkUsers; rows: readonly UserRow[] }) {
  const { nameColumn, shownColumn, roleColumn } = accessText;
  const { lineColumn, passwordColumn, stateColumn } = bulkUsersText;
  return (
    <div class="table-scroll" role="region" aria-label={bulkUsersText.stateColumn} tabIndex={0}>
      <table class="data-table" data-testid="bulk-table">
        <ColumnHeads names={[lineColumn, nameColumn, shownColumn, roleColumn, passwordColumn, stateColumn]} />
        <tbody>
          {rows.map((row) => (
            <tr key={row.line} data-testid={`bulk-line-${row.line}`}>
              <td>{row.line}</td>
              <td>{row.name}</td>
              <td>{row.displayName}</td>
              <td>{isRole(row.role) ? appText.roles[row.role] : row.role}</td>
              <td class="soft">{row.password === '' ? bulkUsersText.generated : bulkUsersText.given}</td>
              <td class="words">
                <RowState row={row} bulk={bulk} />
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function RowState({ row, bulk }: { row: UserRow; bulk: BulkUsers }) {
  const outcome = bulk.outcomes.value.get(row.line) ?? null;
  if (outcome?.created === true) return <span class="good">{bulkUsersText.created}</span>;
  if (outcome?.created === false) return <span class="bad-text">{bulkUsersText.failed(sentence(outcome.reason))}</span>;
  if (row.fault !== null) return <span class="bad-text">{row.fault}</span>;
  return <span class="soft">{row.exists ? bulkUsersText.exists : bulkUsersText.ready}</span>;
}

function CreateBar({ bulk, create }: { bulk: BulkUsers; create: () => Promise<void> }) {
  const faults = bulk.faults.value;
  const open = bulk.open.value.length;
  const [created, failed] = [bulk.created.value, bulk.failed.value];
  const label = bulk.tried.value ? bulkUsersText.tryAgain(open) : bulkUsersText.create(open);
  return (
    <div class="content-form">
      {(open > 0 || bulk.busy.value) && (
        <Button
          look="main"
          testId="bulk-create"
          disabled={bulk.busy.value || faults > 0 || open === 0}
          onClick={() => void create()}
        >
          {bulk.busy.value ? bulkUsersText.progress(created + failed, created + open) : label}
        </Button>
      )}
      <span class="soft" role="status" data-testid="bulk-status">
        {faults > 0 && bulkUsersText.faults(faults)}
        {bulk.tried.value && !bulk.busy.value && bulkUsersText.done(created, failed)}
      </span>
      {bulk.busy.value && <progress aria-label={bulkUsersText.title} value={created + failed} max={created + open} />}
    </div>
  );
}

function Passwords({ bulk }: { bulk: BulkUsers }) {
  const table = bulk.passwordTable;
  return (
    <div class="secret" role="status">
      <p>
        {bulkUsersText.passwords}. {bulkUsersText.passwordsHint}
      </p>
      <textarea
        class="secret-table"
        readOnly
        rows={Math.min(bulk.generated.value.length + 1, 12)}
        aria-label={bulkUsersText.passwords}
        data-testid="bulk-passwords"
        value={table}
        onFocus={(event) => event.currentTarget.select()}
      />
      <CopyButton text={table} words={bulkUsersText.copyAll} testId="bulk-copy" onCopied={() => bulk.noteCopied()} />
    </div>
  );
}
