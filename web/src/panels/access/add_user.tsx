import { useSignal } from '@preact/signals';

import { accessText } from '../../text/access_text';
import type { Remote } from '../../state/remote';
import { type AccessApi } from '../../wire/access_api';
import { appText } from '../../text/app_text';
import { Choice, TextLine } from '../common/form_fields';
import { type AccountRole, type NewUser, type User, accountRoles } from '../../wire/rest_types';
import { Button } from '../common/button';

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
    <form class="content-form" aria-label={accessText.addUser} onSubmit={(event) => void add(event)}>
      <TextLine
        {...{ label: accessText.nameColumn, testId: 'add-name', required: true, value: wanted.value.name }}
        {...{ autocomplete: 'off', verbatim: true }}
        onInput={(name) => set({ name })}
      />
      <TextLine
        {...{ label: accessText.shownColumn, testId: 'add-display-name', value: wanted.value.display_name ?? '' }}
        autocomplete="off"
        onInput={(display_name) => set({ display_name })}
      />
      <Choice
        {...{ label: accessText.roleColumn, testId: 'add-role', value: role }}
        options={roles.map((one) => [one, appText.roles[one]])}
        onChange={(chosen) => set({ role: chosen as AccountRole })}
      />
      <TextLine
        {...{ label: accessText.password, testId: 'add-password', required: true, value: wanted.value.password }}
        {...{ type: 'password', autocomplete: 'new-password', describedBy: 'add-password-rule' }}
        onInput={(password) => set({ password })}
      />
      <Button submit look="main" testId="add-user" disabled={users.busy.value}>
        {accessText.add}
      </Button>
      <p id="add-password-rule" class="soft wide">
        {accessText.passwordRule}
      </p>
    </form>
  );
}
