import { DepthMeter } from '../panels/depth_meter';
import { Figures, Results } from '../panels/figures';
import { ForcePlot } from '../panels/force_plot';
import { Header } from '../panels/header';
import { Picture } from '../panels/picture';
import { PlaybackBar } from '../panels/playback_bar';
import { ProblemBanner } from '../panels/problem_banner';
import { ReplayPanel } from '../panels/replay_panel';
import { RunPanel } from '../panels/run_panel';
import { SessionList } from '../panels/session_list';
import type { BoneScene } from '../scene/scene';
import type { Store } from '../state/store';
import type { Watcher } from '../state/watcher';

/** One session, live or as it was recorded: picture, force, numbers, and what can be done. */
export function LivePage({ store, watcher, scene }: { store: Store; watcher: Watcher; scene: BoneScene }) {
  return (
    <div class={store.replaying.value ? 'page page-replay' : 'page'}>
      <Header store={store} />
      <Picture store={store} scene={scene} />
      {store.replaying.value && <PlaybackBar store={store} watcher={watcher} />}
      <aside class={store.upToDate.value ? 'side' : 'side stale'}>
        {store.replaying.value ? (
          <ReplayPanel store={store} watcher={watcher} />
        ) : (
          <RunPanel store={store} watcher={watcher} />
        )}
        <ProblemBanner store={store} />
        <SessionList store={store} watcher={watcher} />
        <div class="readings">
          <ForcePlot store={store} />
          <DepthMeter store={store} />
          <Figures store={store} />
          <Results store={store} />
        </div>
      </aside>
    </div>
  );
}
