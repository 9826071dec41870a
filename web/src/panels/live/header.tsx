import type { StudyLine as Line } from '../../state/study/study_line';
import type { Store } from '../../state/store';
import type { LinkState } from '../../wire/link';
import { appText } from '../../text/app_text';
import { SiteNav, HeaderEnd } from '../common/site_nav';
import { StudyLine } from './study_line';

const linkStateText: Record<LinkState['kind'], string> = {
  connecting: appText.linkConnecting,
  live: appText.linkConnecting,
  nothing: appText.linkNothing,
  silent: appText.linkSilent,
  lost: appText.linkLost,
  refused: appText.linkRefused,
};

/** In the colour of the link, and of the session while that is live. */
function lookOf(store: Store): string {
  const link = store.link.value.kind;
  if (link !== 'live') return link;
  if (store.replaying.value) return 'replay';
  const state = store.sessionState.value;
  return state === 'running' ? 'live' : state === 'paused' ? 'silent' : state === 'fault' ? 'lost' : 'rest';
}

/** What the session does; while nothing is heard of it, what the link does. */
function badge(store: Store): string {
  const link = store.link.value.kind;
  if (link !== 'live') return linkStateText[link];
  if (store.replaying.value) return appText.linkReplay;
  const state = store.sessionState.value;
  return state === null ? linkStateText.live : appText.state[state];
}

/** What is watched, and what becomes of it. */
export function Header({ store, study }: { store: Store; study: Line }) {
  const hello = store.hello.value;
  const link = store.link.value.kind;
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
      <StudyLine study={study} />
      <HeaderEnd />
      <p class={`link link-${lookOf(store)}`} role="status" data-testid="link-state" data-link={link}>
        <span class="link-dot" aria-hidden="true" />
        {badge(store)}
      </p>
    </header>
  );
}
