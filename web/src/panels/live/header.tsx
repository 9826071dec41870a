import type { Store } from '../../state/store';
import type { LinkState } from '../../wire/link';
import { appText } from '../../text/app_text';
import { SiteNav, HeaderEnd } from '../common/site_nav';

const linkStateText: Record<LinkState['kind'], string> = {
  connecting: appText.linkConnecting,
  live: appText.linkLive,
  nothing: appText.linkNothing,
  silent: appText.linkSilent,
  lost: appText.linkLost,
  refused: appText.linkRefused,
};

/** What is watched, and whether it is live. */
export function Header({ store }: { store: Store }) {
  const hello = store.hello.value;
  const link = store.link.value.kind;
  const look = link === 'live' && store.replaying.value ? 'replay' : link;
  return (
    <header class="header">
      <h1 class="product">
        {appText.product} <span class="tagline">{appText.tagline}</span>
      </h1>
      <SiteNav here="live" />
      {hello !== null && (
        <p class="case" data-testid="case">
          <strong>{appText.side(hello.side)}</strong>
          <span>{hello.caseName || hello.caseId}</span>
        </p>
      )}
      <HeaderEnd />
      <p class={`link link-${look}`} role="status" data-testid="link-state" data-link={link}>
        <span class="link-dot" aria-hidden="true" />
        {look === 'replay' ? appText.linkReplay : linkStateText[link]}
      </p>
    </header>
  );
}
