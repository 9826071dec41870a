import type { Signal } from '@preact/signals';

import { IdentityContext } from '../panels/common/site_nav';
import type { Identity } from '../state/identity';
import { beginPractice } from '../state/practice_choice';
import { addressOfRoute, type Route } from '../state/route';
import { appText } from '../text/app_text';
import { noAnswer } from '../wire/rest';
import { lazyPart } from '../panels/common/lazy_part';
import { LivePage, type LivePageParts } from './live_page';
import { TraineePage } from './trainee_page';
import { LoginPage } from './login_page';

const dashboardPage = lazyPart(() => import('./dashboard_page'));
const casePages = lazyPart(() => import('./case_pages'));
const sessionPages = lazyPart(() => import('./session_pages'));
const trashPage = lazyPart(() => import('./trash_page'));
const auditPage = lazyPart(() => import('./audit_page'));
const reviewPage = lazyPart(() => import('./review_page'));
const studyPages = lazyPart(() => import('./study_pages'));
const rubricPages = lazyPart(() => import('./rubric_pages'));
const feelPage = lazyPart(() => import('./feel_session_page'));
const accessPages = lazyPart(() => import('./access_pages'));

interface Parts {
  route: Signal<Route>;
  live: LivePageParts;
  identity: Identity;
}

/** The page that the address names, for who may see it; else the way in. */
export function App({ route, live, identity }: Parts) {
  return (
    <IdentityContext.Provider value={identity}>
      <Entrance identity={identity}>
        <Page route={route.value} live={live} identity={identity} />
      </Entrance>
    </IdentityContext.Provider>
  );
}

function Entrance({ identity, children }: { identity: Identity; children: preact.ComponentChildren }) {
  switch (identity.phase.value) {
    case 'known':
      return <>{children}</>;
    case 'unknown':
      return <LoginPage />;
    case 'checking':
      return (
        <p class="page-opening" role="status" data-testid="checking-login">
          {identity.problem.value === null
            ? appText.checkingLogin
            : `${identity.problem.value} ${appText.retryingLogin}`}
        </p>
      );
  }
}

function Page({ route, live, identity }: { route: Route; live: LivePageParts; identity: Identity }) {
  const may = identity.may.value;
  switch (route.kind) {
    case 'dashboard':
      if (!may.ream) return <NotForYou />;
      return dashboardPage.show(({ DashboardPage }) => <DashboardPage live={live} />);
    case 'live':
    case 'trainee':
      return <WatchedSession live={live} route={route} />;
    case 'cases':
    case 'case':
      if (!may.readCases) return <NotForYou />;
      return casePages.show(({ CasePages }) => (
        <CasePages
          route={route}
          reaming={{ level: live.choice.level, start: (caseId) => startReaming(caseId, live) }}
        />
      ));
    case 'sessions':
      if (!may.ream) return <NotForYou />;
      return sessionPages.show(({ SessionsPage }) => <SessionsPage live={live} />);
    case 'trash':
      if (!may.teach) return <NotForYou />;
      return trashPage.show(({ TrashPage }) => <TrashPage />);
    case 'review':
      return reviewPage.show(({ ReviewPage }) => <ReviewPage route={route} />);
    case 'studies':
    case 'study':
    case 'questionnaire':
    case 'rating':
      if (!may.takePart) return <NotForYou />;
      return studyPages.show(({ StudyPages }) => <StudyPages route={route} live={live} />);
    case 'rubrics':
    case 'rubric':
    case 'benchmarks':
      if (!may.teach) return <NotForYou />;
      return rubricPages.show(({ RubricPages }) => <RubricPages route={route} />);
    case 'users':
      if (!may.operate) return <NotForYou />;
      return accessPages.show(({ UsersPage }) => <UsersPage />);
    case 'audit':
      if (!may.operate) return <NotForYou />;
      return auditPage.show(({ AuditPage }) => <AuditPage />);
    case 'account':
      if (identity.userId.value === null) return <NotForYou />;
      return accessPages.show(({ AccountPage }) => <AccountPage />);
  }
}

function WatchedSession({ live, route }: { live: LivePageParts; route: Route }) {
  // Who reams in theatre sees no panels, wherever the page was opened.
  if (live.view.theatre.value) return <TraineePage {...live} />;
  const hidden = live.feel.hidden.value;
  if (hidden !== null) return feelPage.show(({ FeelSessionPage }) => <FeelSessionPage live={live} session={hidden} />);
  return route.kind === 'trainee' ? <TraineePage {...live} /> : <LivePage {...live} />;
}

function NotForYou() {
  return (
    <p class="page-opening" role="status" data-testid="forbidden">
      {appText.forbidden} <a href={addressOfRoute({ kind: 'live' })}>{appText.backToLivePage}</a>
    </p>
  );
}

/** Makes a session on a case, takes the reamer into the hand, and shows it; throws an Error with words when it fails. */
async function startReaming(caseId: string, { watcher, practice, choice, store }: LivePageParts): Promise<void> {
  if (store.replayId.value !== null) watcher.leaveReplay();
  const sessionId = await beginPractice({ watcher, practice, choice }, caseId);
  if (sessionId === null) {
    const reason = store.problem.value ?? noAnswer;
    store.problem.value = null;
    throw new Error(reason);
  }
  window.location.hash = '';
}
