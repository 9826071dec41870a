import { useSignal } from '@preact/signals';

import { accessText } from '../../text/access_text';
import { addressOfLink } from '../../state/watch_link';
import { type AccessApi, utcInDays } from '../../wire/access_api';
import { messageOf } from '../../wire/rest';
import { Message } from '../common/fields';
import { SecretOnce } from '../common/secret_once';
import { Choice, Count, TextLine } from '../common/form_fields';
import { Button } from '../common/button';

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
      <form class="content-form" onSubmit={(event) => void make(event)}>
        <TextLine
          {...{ label: accessText.linkName, testId: 'link-name', autocomplete: 'off', value: name.value }}
          onInput={(typed) => (name.value = typed)}
        />
        <Count
          {...{ label: accessText.days, testId: 'link-days', min: 1, max: 365, value: days.value }}
          onChange={(count) => (days.value = count)}
        />
        {session !== null && (
          <Choice
            {...{ label: accessText.showsColumn, testId: 'link-for', value: all.value ? 'all' : 'this' }}
            options={[
              ['this', accessText.shareThis],
              ['all', accessText.shareAll],
            ]}
            onChange={(chosen) => (all.value = chosen === 'all')}
          />
        )}
        <Button submit look="main" testId="make-link" disabled={busy.value}>
          {accessText.makeLink}
        </Button>
      </form>
      {problem.value !== null && <Message kind="bad">{problem.value}</Message>}
      {address.value !== null && <SecretOnce label={accessText.links} text={address.value} testId="link-address" />}
    </>
  );
}
