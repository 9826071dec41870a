import type { Store } from '../state/store';
import type { LinkState } from '../wire/link';
import { words } from '../words';
import { SiteNav, WhoAmI } from './site_nav';

const linkWords: Record<LinkState['kind'], string> = {
  connecting: words.linkConnecting,
  live: words.linkLive,
  nothing: words.linkNothing,
  silent: words.linkSilent,
  lost: words.linkLost,
  refused: words.linkRefused,
};

/** What is watched, and whether it is live. */
export function Header({ store }: { store: Store }) {
  const hello = store.hello.value;
  const link = store.link.value.kind;
  const look = link === 'live' && store.replaying.value ? 'replay' : link;
  return (
    <header class="header">
      <h1 class="product">
        {words.product} <span class="tagline">{words.tagline}</span>
      </h1>
      <SiteNav here="live" />
      {hello !== null && (
        <p class="case" data-testid="case">
          <strong>{words.side(hello.side)}</strong>
          <span>{hello.caseName || hello.caseId}</span>
        </p>
      )}
      <WhoAmI />
      <p class={`link link-${look}`} role="status" data-testid="link-state" data-link={link}>
        <span class="link-dot" aria-hidden="true" />
        {look === 'replay' ? words.linkReplay : linkWords[link]}
      </p>
    </header>
  );
}
