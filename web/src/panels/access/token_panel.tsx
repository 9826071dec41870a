import { useSignal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';

import { accessText } from '../../text/access_text';
import { Remote } from '../../state/remote';
import { type AccessApi, utcInDays } from '../../wire/access_api';
import { dayAndTime, dayYearAndTime } from '../../text/format';
import { Message } from '../common/fields';
import { ConfirmButton } from '../common/confirm_dialog';
import { SecretOnce } from '../common/secret_once';
import { Count, TextLine } from '../common/form_fields';
import { Button } from '../common/button';
import { ActionsColumn } from '../common/actions_column';

const usualDays = 90;

interface Parts {
  api: AccessApi;
  /** Whose; null: everybody's, and none can be made here. */
  userId: string | null;
  nameOf?: (userId: string) => string;
}

/** Tokens for programs: those there are, and for oneself another. */
export function TokenPanel({ api, userId, nameOf }: Parts) {
  const tokens = useMemo(() => new Remote(() => api.tokens(userId)), [api, userId]);
  useEffect(() => void tokens.read(), [tokens]);
  const list = tokens.value.value;
  return (
    <section class="content-panel" aria-labelledby="tokens-title">
      <h2 id="tokens-title">{accessText.tokens}</h2>
      <p class="soft">
        {accessText.tokensHint} <a href="./api">{accessText.apiPage}</a>
      </p>
      {tokens.problem.value !== null && <Message kind="bad">{tokens.problem.value}</Message>}
      {list?.length === 0 && <p class="soft">{accessText.noTokens}</p>}
      {list !== null && list.length > 0 && (
        <div class="table-scroll">
          <table class="data-table" data-testid="tokens">
            <thead>
              <tr>
                <th scope="col">{accessText.tokenName}</th>
                {nameOf !== undefined && <th scope="col">{accessText.whoseColumn}</th>}
                <th scope="col">{accessText.usedColumn}</th>
                <th scope="col">{accessText.untilColumn}</th>
                <ActionsColumn />
              </tr>
            </thead>
            <tbody>
              {list.map((token) => (
                <tr key={token.id}>
                  <td>{token.name}</td>
                  {nameOf !== undefined && <td>{nameOf(token.user_id)}</td>}
                  <td class="when">
                    {token.last_used_utc === null ? accessText.never : dayAndTime(token.last_used_utc)}
                  </td>
                  <td class="when">{dayYearAndTime(token.expires_utc)}</td>
                  <td class="actions">
                    <ConfirmButton
                      label={accessText.revoke}
                      describe={accessText.revokeToken(token.name)}
                      question={`${accessText.revokeToken(token.name)}?`}
                      yes={accessText.revoke}
                      no={accessText.keep}
                      testId={`revoke-${token.id}`}
                      onYes={() => void tokens.act(() => api.revokeToken(token.id))}
                    />
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
      {userId !== null && <MakeToken api={api} tokens={tokens} />}
    </section>
  );
}

function MakeToken({ api, tokens }: { api: AccessApi; tokens: Remote<unknown> }) {
  const name = useSignal('');
  const days = useSignal(usualDays);
  const secret = useSignal<string | null>(null);
  const make = async (event: Event) => {
    event.preventDefault();
    const made = await tokens.act(() => api.addToken(name.value.trim(), utcInDays(days.value)));
    if (made === null) return;
    secret.value = made.secret;
    name.value = '';
  };
  return (
    <>
      <form class="content-form" onSubmit={(event) => void make(event)}>
        <TextLine
          {...{
            label: accessText.tokenName,
            testId: 'token-name',
            required: true,
            autocomplete: 'off',
            value: name.value,
          }}
          onInput={(typed) => (name.value = typed)}
        />
        <Count
          {...{ label: accessText.days, testId: 'token-days', min: 1, max: 3650, value: days.value }}
          onChange={(count) => (days.value = count)}
        />
        <Button submit look="main" testId="make-token" disabled={tokens.busy.value}>
          {accessText.makeToken}
        </Button>
      </form>
      {secret.value !== null && <SecretOnce label={accessText.tokens} text={secret.value} testId="token-secret" />}
    </>
  );
}
