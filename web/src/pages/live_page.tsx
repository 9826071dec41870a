import { DepthMeter } from '../panels/depth_meter';
import { Figures, Results } from '../panels/figures';
import { ForcePlot } from '../panels/force_plot';
import { Header } from '../panels/header';
import { Picture } from '../panels/picture';
import { ProblemBanner } from '../panels/problem_banner';
import { RunPanel } from '../panels/run_panel';
import type { BoneScene } from '../scene/scene';
import type { Store } from '../state/store';
import type { Watcher } from '../state/watcher';

/** One session, live: picture, force, numbers, and the button that starts it. */
export function LivePage({ store, watcher, scene }: { store: Store; watcher: Watcher; scene: BoneScene }) {
  return (
    <div class="page">
      <Header store={store} />
      <Picture store={store} scene={scene} />
      <aside class={store.live.value ? 'side' : 'side stale'}>
        <RunPanel store={store} watcher={watcher} />
        <ProblemBanner store={store} />
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
