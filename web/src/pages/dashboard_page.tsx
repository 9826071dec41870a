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
  const { watcher, store } = live;
  const identity = useIdentity();
  const own = identity.hasUsers.value && !identity.may.value.teach;
  useEffect(() => dashboard.follow(own), [own]);
  const watch = (id: string) => {
    watcher.watch(id);
    window.location.hash = '';
  };
  const replay = async (id: string) => {
    await watcher.openReplay(id);
    const problem = store.problem.value;
    store.problem.value = null;
    if (problem === null) window.location.hash = addressOfReplay(store.replayId.value);
    return problem;
  };
  return (
    <div class="page desk-page">
      <PageHeader here="dashboard" />
      <main class="desk dashboard" data-testid="dashboard">
        <LivePanel board={dashboard.board} watch={watch} />
        <RecentPanel ended={dashboard.ended} replay={replay} />
        <LearningPanel dashboard={dashboard} own={own} hasUsers={identity.hasUsers.value} />
      </main>
    </div>
  );
}
