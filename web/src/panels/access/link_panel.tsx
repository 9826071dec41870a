import { useEffect, useMemo } from 'preact/hooks';

import { accessText } from '../../text/access_text';
import { Remote } from '../../state/remote';
import type { AccessApi } from '../../wire/access_api';
import { dayAndTime, dayYearAndTime } from '../../text/format';
import { Message } from '../common/fields';
import { ConfirmButton } from '../common/confirm_dialog';
import { MakeLink } from './make_link';
import { ActionsColumn } from '../common/actions_column';

/** Links with which people watch without an account: those there are, and another. */
export function LinkPanel({ api }: { api: AccessApi }) {
  const links = useMemo(() => new Remote(() => api.links()), [api]);
  useEffect(() => void links.read(), [links]);
  const list = links.value.value;
  return (
    <section class="content-panel" aria-labelledby="links-title">
      <h2 id="links-title">{accessText.links}</h2>
      <p class="soft">{accessText.linksHint}</p>
      {links.problem.value !== null && <Message kind="bad">{links.problem.value}</Message>}
      {list !== null && list.length > 0 && (
        <div class="table-scroll">
          <table class="data-table" data-testid="links">
            <thead>
              <tr>
                <th scope="col">{accessText.linkName}</th>
                <th scope="col">{accessText.showsColumn}</th>
                <th scope="col">{accessText.usedColumn}</th>
                <th scope="col">{accessText.untilColumn}</th>
                <ActionsColumn />
              </tr>
            </thead>
            <tbody>
              {list.map((link) => (
                <tr key={link.id}>
                  <td>{link.name || <span class="soft">{accessText.unnamed}</span>}</td>
                  <td>{link.session === null ? accessText.allSessions : accessText.oneSession(link.session)}</td>
                  <td class="when">
                    {link.last_used_utc === null ? accessText.never : dayAndTime(link.last_used_utc)}
                  </td>
                  <td class="when">{dayYearAndTime(link.expires_utc)}</td>
                  <td class="actions">
                    <ConfirmButton
                      label={accessText.revoke}
                      describe={accessText.revokeLink(link.name || link.id)}
                      question={`${accessText.revokeLink(link.name || link.id)}?`}
                      yes={accessText.revoke}
                      no={accessText.keep}
                      testId={`revoke-${link.id}`}
                      onYes={() => void links.act(() => api.revokeLink(link.id))}
                    />
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
      <MakeLink api={api} session={null} onMade={() => void links.read()} />
    </section>
  );
}
