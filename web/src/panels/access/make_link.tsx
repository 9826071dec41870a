import { useSignal } from '@preact/signals';

import { accessText } from '../../text/access_text';
import { addressOfLink } from '../../state/watch_link';
import { type AccessApi, utcInDays } from '../../wire/access_api';
import { messageOf } from '../../wire/rest';
import { Remark } from '../common/fields';
import { SecretOnce } from '../common/secret_once';

const usualDays = 7;

interface Parts {
  api: AccessApi;
  /** That the link is for; null: all sessions. With one, the user chooses between it and all. */
  session: string | null;
  /** The link leads to the session's review. */
  review?: boolean;
  onMade: () => void;
}

/** The form for a viewer link, and the link once it is made. */
export function MakeLink({ api, session, review, onMade }: Parts) {
  const name = useSignal('');
  const days = useSignal(usualDays);
  const all = useSignal(session === null);
  const busy = useSignal(false);
  const problem = useSignal<string | null>(null);
  const address = useSignal<string | null>(null);
  const make = async (event: Event) => {
    event.preventDefault();
    busy.value = true;
    problem.value = null;
    try {
      const only = all.value ? null : session;
      const made = await api.addLink(name.value.trim(), only, utcInDays(days.value));
      address.value = addressOfLink(window.location.origin, made.secret, review === true ? session : null);
      onMade();
    } catch (error) {
      problem.value = messageOf(error);
    } finally {
      busy.value = false;
    }
  };
  return (
    <>
      <form class="desk-form" onSubmit={(event) => void make(event)}>
        <label>
          {accessText.linkName}
          <input
            type="text"
            autocomplete="off"
            data-testid="link-name"
            value={name.value}
            onInput={(event) => (name.value = event.currentTarget.value)}
          />
        </label>
        <label>
          {accessText.days}
          <input
            type="number"
            min={1}
            max={365}
            required
            data-testid="link-days"
            value={days.value}
            onChange={(event) => (days.value = event.currentTarget.valueAsNumber)}
          />
        </label>
        {session !== null && (
          <label>
            {accessText.showsColumn}
            <select
              data-testid="link-for"
              value={all.value ? 'all' : 'this'}
              onChange={(event) => (all.value = event.currentTarget.value === 'all')}
            >
              <option value="this">{accessText.shareThis}</option>
              <option value="all">{accessText.shareAll}</option>
            </select>
          </label>
        )}
        <button type="submit" class="main-button" data-testid="make-link" disabled={busy.value}>
          {accessText.makeLink}
        </button>
      </form>
      {problem.value !== null && <Remark kind="bad">{problem.value}</Remark>}
      {address.value !== null && <SecretOnce label={accessText.links} text={address.value} testId="link-address" />}
    </>
  );
}
