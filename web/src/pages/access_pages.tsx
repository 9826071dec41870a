import '../styles/pages.css';

import { useEffect, useMemo } from 'preact/hooks';

import { accessText } from '../text/access_text';
import { AddUser } from '../panels/access/add_user';
import { BulkUsersPanel } from '../panels/access/bulk_users';
import { LinkPanel } from '../panels/access/link_panel';
import { PasswordPanel } from '../panels/access/password_panel';
import { TokenPanel } from '../panels/access/token_panel';
import { UserTable } from '../panels/access/user_table';
import { PageHeader } from '../panels/common/page_header';
import { Message } from '../panels/common/fields';
import { useIdentity } from '../panels/common/site_nav';
import { Remote } from '../state/remote';
import { addressOfRoute } from '../state/route';
import { pageText } from '../text/page_text';
import { AccessApi } from '../wire/access_api';
import { LoginApi } from '../wire/login_api';

const api = new AccessApi(window.location.origin);
const loginApi = new LoginApi(window.location.origin);

/** Who may do what, for operators. */
export function UsersPage() {
  const identity = useIdentity();
  // The first user ends the time in which everybody was an operator.
  const users = useMemo(() => new Remote(() => api.users()), []);
  useEffect(() => void users.read(), [users]);
  const list = users.value.value;
  const nameOf = (id: string) => list?.find((user) => user.id === id)?.name ?? id;
  return (
    <div class="page content-page">
      <PageHeader here="users" />
      <main class="content">
        <section class="content-panel" aria-labelledby="users-title">
          <div class="content-head">
            <h2 id="users-title">{accessText.users}</h2>
            <a class="content-count" data-testid="to-audit" href={addressOfRoute({ kind: 'audit' })}>
              {pageText.auditLog}
            </a>
          </div>
          {users.problem.value !== null && (
            <Message kind="bad" testId="users-problem">
              {users.problem.value}
            </Message>
          )}
          {list === null && users.problem.value === null && <p class="soft">{accessText.loading}</p>}
          {list?.length === 0 && (
            <Message kind="warn">
              {accessText.noUsers} {accessText.firstUser}
            </Message>
          )}
          {list !== null && list.length > 0 && <UserTable api={api} users={users} />}
          {list !== null && <AddUser api={api} users={users} />}
        </section>
        {list !== null && list.length > 0 && <BulkUsersPanel api={api} users={users} />}
        {identity.hasUsers.value && <TokenPanel api={api} userId={null} nameOf={nameOf} />}
        {identity.hasUsers.value && <LinkPanel api={api} />}
      </main>
    </div>
  );
}

/** One's own password and tokens. */
export function AccountPage() {
  const identity = useIdentity();
  return (
    <div class="page content-page">
      <PageHeader here="account" />
      <main class="content" aria-label={accessText.account}>
        <PasswordPanel api={loginApi} />
        <TokenPanel api={api} userId={identity.userId.value} />
        {identity.may.value.teach && <LinkPanel api={api} />}
      </main>
    </div>
  );
}
