import { createContext } from 'preact';
import { useContext } from 'preact/hooks';

import type { Identity } from '../../state/identity';
import type { Permissions } from '../../state/permissions';
import { addressOfRoute, type Route } from '../../state/route';
import { appText } from '../../text/app_text';
import { pageText } from '../../text/page_text';
import { ThemeButton } from './theme_button';

/** Who uses the page; given once at its root. */
export const IdentityContext = createContext<Identity | null>(null);

export function useIdentity(): Identity {
  const identity = useContext(IdentityContext);
  if (identity === null) throw new Error('no identity is provided');
  return identity;
}

function waysFor(may: Permissions): (readonly [Route, string])[] {
  const links: readonly (readonly [Route, string, boolean])[] = [
    [{ kind: 'dashboard' }, appText.dashboard, may.ream],
    [{ kind: 'live' }, appText.live, true],
    [{ kind: 'sessions' }, appText.sessionsPage, may.ream],
    [{ kind: 'cases' }, appText.cases, may.readCases],
    [{ kind: 'studies' }, appText.studies, may.takePart],
    [{ kind: 'rubrics' }, appText.rubrics, may.teach],
    [{ kind: 'users' }, appText.users, may.operate],
  ];
  return links.flatMap(([route, text, offered]) => (offered ? [[route, text] as const] : []));
}

/** The ways to the pages that the user may see. */
export function SiteNav({ here }: { here: Route['kind'] }) {
  const shown = waysFor(useIdentity().may.value);
  if (shown.length < 2) return null;
  return (
    <nav class="site-links" aria-label={appText.pages}>
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

/** What stands at the end of every header. */
export function HeaderEnd() {
  return (
    <div class="header-end">
      {/* Leaving the page would end the control of a session. */}
      <a
        class="help-link"
        href="./docs/"
        target="_blank"
        rel="noopener"
        title={pageText.helpHint}
        data-testid="to-help"
      >
        {pageText.help}
      </a>
      <ThemeButton />
      <WhoAmI />
    </div>
  );
}

/** Who is logged in, and the way out. Nothing on a server without users. */
function WhoAmI() {
  const identity = useIdentity();
  const role = identity.visitor.value?.role ?? null;
  if (!identity.hasUsers.value || role === null) return null;
  const name = identity.name.value;
  return (
    <div
      class="current-user"
      data-testid="current-user"
      data-role={role}
      title={role === 'viewer' ? appText.viewerHint : undefined}
    >
      <span class="visually-hidden">{appText.whoLabel} </span>
      {name !== null && (
        <a href={addressOfRoute({ kind: 'account' })} data-testid="to-account" title={appText.account}>
          {name}
        </a>
      )}
      <span class="role-chip">{appText.roles[role]}</span>
      {name !== null && (
        <button
          type="button"
          class="link-button"
          data-testid="log-out"
          disabled={identity.busy.value}
          onClick={() => void identity.logOut()}
        >
          {appText.logOut}
        </button>
      )}
    </div>
  );
}
