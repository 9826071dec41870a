import { useSignal } from '@preact/signals';

import { accessText } from '../../text/access_text';
import type { Remote } from '../../state/remote';
import { type AccessApi } from '../../wire/access_api';
import { appText } from '../../text/app_text';
import { dayAndTime } from '../../text/format';
import { useFocusAfter } from '../common/focus_after';
import { ConfirmButton } from '../common/confirm_dialog';
import { useIdentity } from '../common/site_nav';
import { type AccountRole, type User, accountRoles } from '../../wire/rest_types';
import { Button } from '../common/button';
import { ActionsColumn } from '../common/actions_column';

interface Parts {
  api: AccessApi;
  users: Remote<User[]>;
}

/** All accounts, and what can be done about each. */
export function UserTable({ api, users }: Parts) {
  const list = users.value.value ?? [];
  return (
    <div class="table-scroll">
      <table class={users.stale.value ? 'data-table stale' : 'data-table'} data-testid="users">
        <thead>
          <tr>
            <th scope="col">{accessText.nameColumn}</th>
            <th scope="col">{accessText.shownColumn}</th>
            <th scope="col">{accessText.roleColumn}</th>
            <th scope="col">{accessText.stateColumn}</th>
            <th scope="col">{accessText.sinceColumn}</th>
            <ActionsColumn />
          </tr>
        </thead>
        <tbody>
          {list.map((user) => (
            <UserRow key={user.id} user={user} api={api} users={users} />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function UserRow({ user, api, users }: Parts & { user: User }) {
  const self = useIdentity().userId.value === user.id;
  const busy = users.busy.value;
  const change = (wanted: Parameters<AccessApi['changeUser']>[1]) =>
    void users.act(() => api.changeUser(user.id, wanted));
  return (
    <tr data-testid={`user-${user.name}`}>
      <td>
        {user.name} {self && <span class="soft">({accessText.you})</span>}
      </td>
      <td>{user.display_name}</td>
      <td>
        <select
          aria-label={accessText.roleOf(user.name)}
          data-testid={`role-${user.name}`}
          disabled={busy}
          value={user.role}
          onChange={(event) => change({ role: event.currentTarget.value as AccountRole })}
        >
          {accountRoles.map((role) => (
            <option key={role} value={role}>
              {appText.roles[role]}
            </option>
          ))}
        </select>
      </td>
      <td>
        <span class={user.enabled ? 'chip chip-good' : 'chip chip-warn'}>
          {user.enabled ? accessText.enabled : accessText.disabled}
        </span>
      </td>
      <td class="when">{dayAndTime(user.created_utc)}</td>
      <td class="actions">
        <NewPassword user={user} busy={busy} onSet={(password) => change({ password })} />
        <Button
          testId={`enable-${user.name}`}
          disabled={busy}
          label={user.enabled ? accessText.disableUser(user.name) : accessText.enableUser(user.name)}
          onClick={() => change({ enabled: !user.enabled })}
        >
          {user.enabled ? accessText.disable : accessText.enable}
        </Button>
        <ConfirmButton
          label={accessText.remove}
          describe={accessText.removeUser(user.name)}
          question={accessText.removeConfirm(user.name)}
          yes={accessText.removeYes}
          no={accessText.keep}
          testId={`remove-${user.name}`}
          disabled={busy}
          onYes={() => void users.act(() => api.removeUser(user.id))}
        />
      </td>
    </tr>
  );
}

function NewPassword({ user, busy, onSet }: { user: User; busy: boolean; onSet: (password: string) => void }) {
  const open = useSignal(false);
  const place = useFocusAfter<HTMLButtonElement & HTMLInputElement>(open.value);
  const password = useSignal('');
  if (!open.value)
    return (
      <button
        type="button"
        class="plain-button"
        ref={place}
        data-testid={`password-${user.name}`}
        aria-label={accessText.resetPasswordOf(user.name)}
        onClick={() => (open.value = true)}
      >
        {accessText.resetPassword}
      </button>
    );
  const close = () => {
    open.value = false;
    password.value = '';
  };
  return (
    <form
      class="confirm"
      onSubmit={(event) => {
        event.preventDefault();
        onSet(password.value);
        close();
      }}
    >
      <input
        type="password"
        autocomplete="new-password"
        required
        ref={place}
        aria-label={accessText.resetPasswordOf(user.name)}
        data-testid={`new-password-${user.name}`}
        value={password.value}
        onInput={(event) => (password.value = event.currentTarget.value)}
      />
      <Button submit disabled={busy}>
        {accessText.setPassword}
      </Button>
      <Button onClick={close}>{accessText.cancel}</Button>
      <p class="soft">{accessText.resetPasswordEnds}</p>
    </form>
  );
}
