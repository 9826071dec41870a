import type { LivePageParts } from './live_page';

export function SessionsPage({ live }: { live: LivePageParts }) {
  return <p>{live.store.sessions.value.length}</p>;
}
