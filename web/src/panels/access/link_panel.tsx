import { useEffect, useMemo } from 'preact/hooks';

import { accessWords } from '../../access_words';
import { Remote } from '../../state/remote';
import type { AccessApi } from '../../wire/access_api';
import { dayAndTime } from '../format';
import { Remark } from '../fields';
import { Really } from '../really';
import { MakeLink } from './make_link';

/** Links with which people watch without an account: those there are, and another. */
export function LinkPanel({ api }: { api: AccessApi }) {
  const links = useMemo(() => new Remote(() => api.links()), [api]);
  useEffect(() => void links.read(), [links]);
  const list = links.value.value;
  return (
    <section class="desk-panel" aria-labelledby="links-title">
      <h2 id="links-title">{accessWords.links}</h2>
      <p class="soft">{accessWords.linksHint}</p>
      {links.problem.value !== null && <Remark kind="bad">{links.problem.value}</Remark>}
      {list !== null && list.length > 0 && (
        <div class="desk-scroll">
          <table class="desk-table" data-testid="links">
            <thead>
              <tr>
                <th scope="col">{accessWords.linkName}</th>
                <th scope="col">{accessWords.showsColumn}</th>
                <th scope="col">{accessWords.usedColumn}</th>
                <th scope="col">{accessWords.untilColumn}</th>
                <th />
              </tr>
            </thead>
            <tbody>
              {list.map((link) => (
                <tr key={link.id}>
                  <td>{link.name || <span class="soft">{accessWords.unnamed}</span>}</td>
                  <td>{link.session === null ? accessWords.allSessions : accessWords.oneSession(link.session)}</td>
                  <td>{link.last_used_utc === null ? accessWords.never : dayAndTime(link.last_used_utc)}</td>
                  <td>{dayAndTime(link.expires_utc)}</td>
                  <td class="deeds">
                    <Really
                      label={accessWords.revoke}
                      describe={accessWords.revokeLink(link.name || link.id)}
                      question={`${accessWords.revokeLink(link.name || link.id)}?`}
                      yes={accessWords.revoke}
                      no={accessWords.keep}
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
