import '../styles/pages.css';

import { useEffect, useMemo, useRef } from 'preact/hooks';

import { PageButtons } from '../panels/common/page_buttons';
import { PageHeader } from '../panels/common/page_header';
import { Message } from '../panels/common/fields';
import { FilterBar } from '../panels/sessions/filter_bar';
import { SessionTable } from '../panels/sessions/session_table';
import { pageText } from '../text/page_text';
import { sessionText } from '../text/session_text';
import { useIdentity } from '../panels/common/site_nav';
import { addressOfRoute } from '../state/route';
import { addressOfReplay } from '../state/replay_address';
import { SessionBrowser } from '../state/sessions/session_browser';
import { SessionListApi } from '../wire/session_list_api';
import type { LivePageParts } from './live_page';

const readAgainMs = 5000;
const browser = new SessionBrowser(new SessionListApi(window.location.origin));

/** All sessions that the user may see, of all times. */
export function SessionsPage({ live }: { live: LivePageParts }) {
  const { watcher, store } = live;
  const identity = useIdentity();
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
  const workspace = useRef<HTMLElement>(null);
  const cursors = browser.cursors.value;
  useEffect(() => workspace.current?.scrollTo({ top: 0 }), [cursors]);
  const page = browser.page.value.value;
  const problem = browser.page.problem.value;
  return (
    <div class="page content-page">
      <PageHeader here="sessions" />
      <main class="content" ref={workspace}>
        <section class="content-panel" aria-labelledby="sessions-title">
          <div class="content-head">
            <h2 id="sessions-title">{sessionText.sessions}</h2>
            {page !== null && (
              <span class="soft content-count" role="status" data-testid="session-count">
                {sessionText.count(page.total)}
              </span>
            )}
          </div>
          {identity.may.value.teach && (
            <p class="soft">
              <a data-testid="to-trash" href={addressOfRoute({ kind: 'trash' })}>
                {pageText.deletedSessions}
              </a>
            </p>
          )}
          <FilterBar browser={browser} />
          {problem !== null && (
            <Message kind="bad" testId="sessions-problem">
              {problem}
            </Message>
          )}
          <Deleted />
          {page === null && problem === null && <p class="soft">{sessionText.loading}</p>}
          {page?.sessions.length === 0 && (
            <p class="soft" data-testid="no-sessions">
              {browser.filtered.value ? sessionText.noneFits : sessionText.none}
            </p>
          )}
          {page !== null && page.sessions.length > 0 && (
            <SessionTable browser={browser} watch={acts.watch} replay={(session) => void acts.replay(session)} />
          )}
          <PageButtons list={browser} />
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
      <Message kind="soft" testId="deleted">
        {sessionText.deleted(session.id)}{' '}
        <button type="button" class="link-button" data-testid="restore" onClick={() => void browser.restore()}>
          {sessionText.restore}
        </button>
      </Message>
    </div>
  );
}
