import { createContext } from 'preact';
import { useContext } from 'preact/hooks';

import type { Identity } from '../state/identity';
import { addressOfRoute, type Route } from '../state/route';
import { words } from '../words';

/** Who uses the page; given once at its root. */
export const IdentityContext = createContext<Identity | null>(null);

export function useIdentity(): Identity {
  const identity = useContext(IdentityContext);
  if (identity === null) throw new Error('no identity is provided');
  return identity;
}

/** The ways to the pages that the user may see. */
export function SiteNav({ here }: { here: Route['kind'] }) {
  const identity = useIdentity();
  const may = identity.may.value;
  const ways: readonly (readonly [Route, string, boolean])[] = [
    [{ kind: 'live' }, words.live, true],
    [{ kind: 'sessions' }, words.sessionsPage, may.ream],
    [{ kind: 'cases' }, words.cases, may.readCases],
    [{ kind: 'studies' }, words.studies, may.takePart],
    [{ kind: 'users' }, words.users, may.operate],
  ];
  const shown = ways.filter(([, , offered]) => offered);
  if (shown.length < 2) return null;
  return (
    <nav class="ways" aria-label={words.pages}>
      {shown.map(([route, text]) => (
        <a
          key={route.kind}
          href={addressOfRoute(route)}
          data-testid={`to-${route.kind}`}
          aria-current={route.kind === here ? 'page' : undefined}
        >
          {text}
        </a>
      ))}
    </nav>
  );
}

/** Who is logged in, and the way out. Nothing on a server without users. */
export function WhoAmI() {
  const identity = useIdentity();
  const role = identity.visitor.value?.role ?? null;
  if (!identity.hasUsers.value || role === null) return null;
  const name = identity.name.value;
  return (
    <div class="who" data-testid="who" data-role={role} title={role === 'viewer' ? words.viewerHint : undefined}>
      <span class="visually-hidden">{words.whoLabel} </span>
      {name !== null && (
        <a href={addressOfRoute({ kind: 'account' })} data-testid="to-account" title={words.account}>
          {name}
        </a>
      )}
      <span class="role-chip">{words.roles[role]}</span>
      {name !== null && (
        <button
          type="button"
          class="link-button"
          data-testid="log-out"
          disabled={identity.busy.value}
          onClick={() => void identity.logOut()}
        >
          {words.logOut}
        </button>
      )}
    </div>
  );
}
