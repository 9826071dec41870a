import '../styles/pages.css';
import '../styles/dashboard.css';

import { useEffect } from 'preact/hooks';

import { LearningPanel } from '../panels/dashboard/learning_panel';
import { LivePanel } from '../panels/dashboard/live_panel';
import { RecentPanel } from '../panels/dashboard/recent_panel';
import { PageHeader } from '../panels/common/page_header';
import { useIdentity } from '../panels/common/site_nav';
import { Dashboard } from '../state/dashboard/dashboard';
import { addressOfReplay } from '../state/replay_address';
import { DashboardApi } from '../wire/dashboard_api';
import type { LivePageParts } from './live_page';

const dashboard = new Dashboard(new DashboardApi(window.location.origin), window.location.origin);

/** Who reams now, who has reamed, and how they come on. */
export function DashboardPage({ live }: { live: LivePageParts }) {
  const identity = useIdentity();
  const own = identity.hasUsers.value && !identity.may.value.teach;
  useEffect(() => dashboard.follow(own), [own]);
  const watch = (id: string) => {
    live.watcher.watch(id);
    window.location.hash = '';
  };
  return (
    <div class="page content-page">
      <PageHeader here="dashboard" />
      <main class="content dashboard" data-testid="dashboard">
        <LivePanel board={dashboard.board} watch={watch} />
        <RecentPanel ended={dashboard.ended} replay={(id) => replay(live, id)} />
        <LearningPanel dashboard={dashboard} own={own} hasUsers={identity.hasUsers.value} />
      </main>
    </div>
  );
}

/** Why the recording cannot be shown; null: it is. */
async function replay({ watcher, store }: LivePageParts, id: string): Promise<string | null> {
  await watcher.openReplay(id);
  const problem = store.problem.value;
  store.problem.value = null;
  if (problem === null) window.location.hash = addressOfReplay(store.replayId.value);
  return problem;
}
