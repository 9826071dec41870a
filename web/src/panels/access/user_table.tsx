import { useSignal } from '@preact/signals';

import { accessWords } from '../../access_words';
import type { Remote } from '../../state/remote';
import { type AccessApi, type AccountRole, accountRoles, type User } from '../../wire/access_api';
import { words } from '../../words';
import { dayAndTime } from '../format';
import { useFocusAfter } from '../focus_after';
import { Really } from '../really';
import { useIdentity } from '../site_nav';

interface Parts {
  api: AccessApi;
  users: Remote<User[]>;
}

/** All accounts, and what can be done about each. */
export function UserTable({ api, users }: Parts) {
  const list = users.value.value ?? [];
  return (
    <div class="desk-scroll">
      <table class={users.stale.value ? 'desk-table stale' : 'desk-table'} data-testid="users">
        <thead>
          <tr>
            <th scope="col">{accessWords.nameColumn}</th>
            <th scope="col">{accessWords.shownColumn}</th>
            <th scope="col">{accessWords.roleColumn}</th>
            <th scope="col">{accessWords.stateColumn}</th>
            <th scope="col">{accessWords.sinceColumn}</th>
            <th />
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
        {user.name} {self && <span class="soft">({accessWords.you})</span>}
      </td>
      <td>{user.display_name}</td>
      <td>
        <select
          aria-label={accessWords.roleOf(user.name)}
          data-testid={`role-${user.name}`}
          disabled={busy}
          value={user.role}
          onChange={(event) => change({ role: event.currentTarget.value as AccountRole })}
        >
          {accountRoles.map((role) => (
            <option key={role} value={role}>
              {words.roles[role]}
            </option>
          ))}
        </select>
      </td>
      <td>
        <span class={user.enabled ? 'chip chip-good' : 'chip chip-warn'}>
          {user.enabled ? accessWords.enabled : accessWords.disabled}
        </span>
      </td>
      <td>{dayAndTime(user.created_utc)}</td>
      <td class="deeds">
        <NewPassword user={user} busy={busy} onSet={(password) => change({ password })} />
        <button
          type="button"
          class="plain-button"
          data-testid={`enable-${user.name}`}
          disabled={busy}
          aria-label={user.enabled ? accessWords.disableUser(user.name) : accessWords.enableUser(user.name)}
          onClick={() => change({ enabled: !user.enabled })}
        >
          {user.enabled ? accessWords.disable : accessWords.enable}
        </button>
        <Really
          label={accessWords.remove}
          describe={accessWords.removeUser(user.name)}
          question={accessWords.removeReally(user.name)}
          yes={accessWords.removeYes}
          no={accessWords.keep}
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
        aria-label={accessWords.resetPasswordOf(user.name)}
        onClick={() => (open.value = true)}
      >
        {accessWords.resetPassword}
      </button>
    );
  const close = () => {
    open.value = false;
    password.value = '';
  };
  return (
    <form
      class="really"
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
        aria-label={accessWords.resetPasswordOf(user.name)}
        data-testid={`new-password-${user.name}`}
        value={password.value}
        onInput={(event) => (password.value = event.currentTarget.value)}
      />
      <button type="submit" class="plain-button" disabled={busy}>
        {accessWords.setPassword}
      </button>
      <button type="button" class="plain-button" onClick={close}>
        {accessWords.cancel}
      </button>
    </form>
  );
}
