import { useSignal } from '@preact/signals';

import { accessText } from '../../text/access_text';
import type { Remote } from '../../state/remote';
import { type AccessApi } from '../../wire/access_api';
import { appText } from '../../text/app_text';
import { type AccountRole, type NewUser, type User, accountRoles } from '../../wire/rest_types';

const blank = (role: AccountRole): NewUser => ({ name: '', display_name: '', role, password: '' });

/** The form for another account. */
export function AddUser({ api, users }: { api: AccessApi; users: Remote<User[]> }) {
  const wanted = useSignal<NewUser>(blank('trainee'));
  // Others may be added by an operator only, so there must be one first.
  const first = users.value.value?.length === 0;
  const role = first ? 'operator' : wanted.value.role;
  const roles = first ? (['operator'] as const) : accountRoles;
  const set = (change: Partial<NewUser>) => (wanted.value = { ...wanted.value, ...change });
  const add = async (event: Event) => {
    event.preventDefault();
    const made = await users.act(() => api.addUser({ ...wanted.value, role, name: wanted.value.name.trim() }));
    if (made !== null) wanted.value = blank('trainee');
  };
  return (
    <form class="desk-form" aria-label={accessText.addUser} onSubmit={(event) => void add(event)}>
      <label>
        {accessText.nameColumn}
        <input
          type="text"
          autocomplete="off"
          autocapitalize="none"
          spellcheck={false}
          required
          data-testid="add-name"
          value={wanted.value.name}
          onInput={(event) => set({ name: event.currentTarget.value })}
        />
      </label>
      <label>
        {accessText.shownColumn}
        <input
          type="text"
          autocomplete="off"
          data-testid="add-display-name"
          value={wanted.value.display_name}
          onInput={(event) => set({ display_name: event.currentTarget.value })}
        />
      </label>
      <label>
        {accessText.roleColumn}
        <select
          data-testid="add-role"
          value={role}
          onChange={(event) => set({ role: event.currentTarget.value as AccountRole })}
        >
          {roles.map((role) => (
            <option key={role} value={role}>
              {appText.roles[role]}
            </option>
          ))}
        </select>
      </label>
      <label>
        {accessText.password}
        <input
          type="password"
          autocomplete="new-password"
          required
          aria-describedby="add-password-rule"
          data-testid="add-password"
          value={wanted.value.password}
          onInput={(event) => set({ password: event.currentTarget.value })}
        />
      </label>
      <button type="submit" class="main-button" data-testid="add-user" disabled={users.busy.value}>
        {accessText.add}
      </button>
      <p id="add-password-rule" class="soft wide">
        {accessText.passwordRule}
      </p>
    </form>
  );
}
