import { useSignal } from '@preact/signals';

import { accessText } from '../../text/access_text';
import type { LoginApi } from '../../wire/login_api';
import { messageOf } from '../../wire/rest';
import { Message } from '../common/fields';
import { TextLine } from '../common/form_fields';
import { Button } from '../common/button';

/** Changes one's own password. */
export function PasswordPanel({ api }: { api: LoginApi }) {
  const fields = { present: useSignal(''), wanted: useSignal(''), again: useSignal('') };
  const busy = useSignal(false);
  const status = useSignal<{ kind: 'bad' | 'soft'; text: string } | null>(null);
  const change = async (event: Event) => {
    event.preventDefault();
    if (fields.wanted.value !== fields.again.value) {
      status.value = { kind: 'bad', text: accessText.passwordsDiffer };
      return;
    }
    busy.value = true;
    try {
      await api.changePassword(fields.present.value, fields.wanted.value);
      status.value = { kind: 'soft', text: accessText.passwordChanged };
    } catch (error) {
      status.value = { kind: 'bad', text: messageOf(error) };
    } finally {
      for (const field of Object.values(fields)) field.value = '';
      busy.value = false;
    }
  };
  const rows = [
    ['present', accessText.presentPassword, 'current-password'],
    ['wanted', accessText.newPassword, 'new-password'],
    ['again', accessText.newPasswordAgain, 'new-password'],
  ] as const;
  return (
    <section class="content-panel" aria-labelledby="password-title">
      <h2 id="password-title">{accessText.changePassword}</h2>
      <p class="soft">{accessText.passwordRule}</p>
      <p class="soft">{accessText.passwordEnds}</p>
      <form class="content-form" onSubmit={(event) => void change(event)}>
        {rows.map(([key, label, autocomplete]) => (
          <TextLine
            key={key}
            {...{ label, testId: `password-${key}`, type: 'password', required: true, autocomplete }}
            value={fields[key].value}
            onInput={(typed) => (fields[key].value = typed)}
          />
        ))}
        <Button submit look="main" testId="change-password" disabled={busy.value}>
          {accessText.changePassword}
        </Button>
      </form>
      {status.value !== null && (
        <Message kind={status.value.kind} testId="password-status">
          {status.value.text}
        </Message>
      )}
    </section>
  );
}
