import '../desk.css';

import { useEffect, useMemo, useRef } from 'preact/hooks';

import { DeskHeader } from '../panels/desk_header';
import { Remark } from '../panels/fields';
import { FilterBar } from '../panels/sessions/filter_bar';
import { SessionTable } from '../panels/sessions/session_table';
import { sessionWords } from '../session_words';
import { addressOfReplay } from '../state/replay_address';
import { SessionBrowser } from '../state/sessions/session_browser';
import { SessionListApi } from '../wire/session_list_api';
import type { LivePageParts } from './live_page';

const readAgainMs = 5000;
const browser = new SessionBrowser(new SessionListApi(window.location.origin));

/** All sessions that the user may see, of all times. */
export function SessionsPage({ live }: { live: LivePageParts }) {
  const { watcher, store } = live;
  const acts = useMemo(
    () => ({
      watch: (session: { id: string }) => {
        watcher.watch(session.id);
        window.location.hash = '';
      },
      replay: async (session: { id: string }) => {
        await watcher.openReplay(session.id);
        if (store.problem.value === null) window.location.hash = addressOfReplay(store.replayId.value);
        else browser.page.problem.value = store.problem.value;
        store.problem.value = null;
      },
    }),
    [watcher, store],
  );
  useEffect(() => {
    void browser.page.read();
    const timer = setInterval(() => void browser.page.read(), readAgainMs);
    return () => clearInterval(timer);
  }, []);
  // Another page of the list is read from its beginning.
  const desk = useRef<HTMLElement>(null);
  const cursors = browser.cursors.value;
  useEffect(() => desk.current?.scrollTo({ top: 0 }), [cursors]);
  const page = browser.page.value.value;
  const problem = browser.page.problem.value;
  return (
    <div class="page desk-page">
      <DeskHeader here="sessions" />
      <main class="desk" ref={desk}>
        <section class="desk-panel" aria-labelledby="sessions-title">
          <div class="desk-head">
            <h2 id="sessions-title">{sessionWords.sessions}</h2>
            {page !== null && (
              <span class="soft desk-count" role="status" data-testid="session-count">
                {sessionWords.count(page.total)}
              </span>
            )}
          </div>
          <FilterBar browser={browser} />
          {problem !== null && (
            <Remark kind="bad" testId="sessions-problem">
              {problem}
            </Remark>
          )}
          <Deleted />
          {page === null && problem === null && <p class="soft">{sessionWords.loading}</p>}
          {page?.sessions.length === 0 && (
            <p class="soft" data-testid="no-sessions">
              {browser.filtered.value ? sessionWords.noneFits : sessionWords.none}
            </p>
          )}
          {page !== null && page.sessions.length > 0 && (
            <SessionTable browser={browser} watch={acts.watch} replay={(session) => void acts.replay(session)} />
          )}
          <Pages />
        </section>
      </main>
    </div>
  );
}

function Deleted() {
  const session = browser.deleted.value;
  if (session === null) return null;
  return (
    <div role="status">
      <Remark kind="soft" testId="deleted">
        {sessionWords.deleted(session.id)}{' '}
        <button type="button" class="link-button" data-testid="restore" onClick={() => void browser.restore()}>
          {sessionWords.restore}
        </button>
      </Remark>
    </div>
  );
}

function Pages() {
  const at = browser.cursors.value.length;
  const next = browser.page.value.value?.next ?? null;
  if (at === 1 && next === null) return null;
  return (
    <nav class="desk-form pages" aria-label={sessionWords.page(at)}>
      <button
        type="button"
        class="plain-button"
        data-testid="previous-page"
        disabled={at === 1}
        onClick={() => void browser.previous()}
      >
        {sessionWords.previousPage}
      </button>
      <span class="soft" aria-live="polite">
        {sessionWords.page(at)}
      </span>
      <button
        type="button"
        class="plain-button"
        data-testid="next-page"
        disabled={next === null}
        onClick={() => void browser.next()}
      >
        {sessionWords.nextPage}
      </button>
    </nav>
  );
}
