import { useSignal } from '@preact/signals';

import { accessWords } from '../../access_words';
import type { LoginApi } from '../../wire/login_api';
import { wordsOf } from '../../wire/rest';
import { Remark } from '../fields';

/** Changes one's own password. */
export function PasswordPanel({ api }: { api: LoginApi }) {
  const fields = { present: useSignal(''), wanted: useSignal(''), again: useSignal('') };
  const busy = useSignal(false);
  const said = useSignal<{ kind: 'bad' | 'soft'; text: string } | null>(null);
  const change = async (event: Event) => {
    event.preventDefault();
    if (fields.wanted.value !== fields.again.value) {
      said.value = { kind: 'bad', text: accessWords.passwordsDiffer };
      return;
    }
    busy.value = true;
    try {
      await api.changePassword(fields.present.value, fields.wanted.value);
      said.value = { kind: 'soft', text: accessWords.passwordChanged };
    } catch (error) {
      said.value = { kind: 'bad', text: wordsOf(error) };
    } finally {
      for (const field of Object.values(fields)) field.value = '';
      busy.value = false;
    }
  };
  const rows = [
    ['present', accessWords.presentPassword, 'current-password'],
    ['wanted', accessWords.newPassword, 'new-password'],
    ['again', accessWords.newPasswordAgain, 'new-password'],
  ] as const;
  return (
    <section class="desk-panel" aria-labelledby="password-title">
      <h2 id="password-title">{accessWords.changePassword}</h2>
      <p class="soft">{accessWords.passwordRule}</p>
      <form class="desk-form" onSubmit={(event) => void change(event)}>
        {rows.map(([key, label, autocomplete]) => (
          <label key={key}>
            {label}
            <input
              type="password"
              required
              autocomplete={autocomplete}
              data-testid={`password-${key}`}
              value={fields[key].value}
              onInput={(event) => (fields[key].value = event.currentTarget.value)}
            />
          </label>
        ))}
        <button type="submit" class="main-button" data-testid="change-password" disabled={busy.value}>
          {accessWords.changePassword}
        </button>
      </form>
      {said.value !== null && (
        <Remark kind={said.value.kind} testId="password-said">
          {said.value.text}
        </Remark>
      )}
    </section>
  );
}
