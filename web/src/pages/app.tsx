import { signal, type Signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import type { Route } from '../state/route';
import { words } from '../words';
import { LivePage, type LivePageParts } from './live_page';

type CasePagesModule = typeof import('./case_pages');

const casePages = signal<CasePagesModule | 'failed' | null>(null);

/** The page that the address names. Those of the cases are loaded when they are first wanted. */
export function App({ route, live }: { route: Signal<Route>; live: LivePageParts }) {
  const shown = route.value;
  const wanted = shown.kind !== 'live';
  useEffect(() => {
    if (!wanted || (casePages.value !== null && casePages.value !== 'failed')) return;
    casePages.value = null;
    import('./case_pages').then(
      (loaded) => (casePages.value = loaded),
      () => (casePages.value = 'failed'),
    );
  }, [wanted]);
  if (shown.kind === 'live') return <LivePage {...live} />;
  const loaded = casePages.value;
  if (loaded === null || loaded === 'failed')
    return (
      <p class="page-opening" role="status">
        {loaded === null ? words.openingCases : words.casesNotLoaded}
      </p>
    );
  return <loaded.CasePages route={shown} startReaming={(caseId) => startReaming(caseId, live)} />;
}

/** Makes a session on a case, takes the reamer into the hand, and shows it; throws an Error with words when it fails. */
async function startReaming(caseId: string, { watcher, practice, store }: LivePageParts): Promise<void> {
  if (store.replayId.value !== null) watcher.leaveReplay();
  const sessionId = await watcher.practise(caseId);
  if (sessionId === null) {
    const said = store.problem.value ?? words.noAnswer;
    store.problem.value = null;
    throw new Error(said);
  }
  window.location.hash = '';
  practice.steer(sessionId);
}
