import { DepthMeter } from '../panels/live/depth_meter';
import { Figures } from '../panels/live/figures';
import { type ReadonlySignal, signal } from '@preact/signals';

import { ForcePlots } from '../panels/live/force_plot';
import { lazyPart } from '../panels/common/lazy_part';
import { LiveStrip } from '../panels/live/live_strip';
import { Gauges } from '../panels/live/gauges';
import { Header } from '../panels/live/header';
import { HealthPanel } from '../panels/live/health_panel';
import { Picture } from '../panels/live/picture';
import { PlaybackBar } from '../panels/picture/playback_bar';
import { PracticeBar } from '../panels/live/practice_bar';
import { useIdentity } from '../panels/common/site_nav';
import { ProblemBanner } from '../panels/common/problem_banner';
import { AnnotationsPanel } from '../panels/live/annotations_panel';
import { ReplayPanel } from '../panels/live/replay_panel';
import { ResultCard } from '../panels/live/result_card';
import { RunPanel } from '../panels/live/run_panel';
import { SessionList } from '../panels/live/session_list';
import { TutorialPanel } from '../panels/live/tutorial_panel';
import type { BoneScene } from '../scene/scene';
import type { Alarms } from '../state/alarms';
import type { CommentNotices } from '../state/comment_notices';
import type { Health } from '../state/health';
import type { Latency } from '../state/latency';
import type { LiveCase } from '../state/live_case';
import type { LiveAnnotations } from '../state/live_annotations';
import type { Practice } from '../state/practice';
import type { PracticeChoice } from '../state/practice_choice';
import type { PracticeStore } from '../state/practice_store';
import type { ResultWatch } from '../state/result_watch';
import type { Sound } from '../state/sound';
import type { Store } from '../state/store';
import type { Tutorial } from '../state/tutorial_guide';
import type { StudyLine } from '../state/study/study_line';
import type { FeelWatch } from '../state/study/feel_watch';
import type { ViewSettings } from '../state/view_settings';
import type { Watcher } from '../state/watcher';
import type { ReviewApi } from '../wire/review_api';

const slices = lazyPart(() => import('../panels/picture/live_slices'));
const slicesOpen = signal(false);

export interface LivePageParts {
  store: Store;
  watcher: Watcher;
  scene: BoneScene;
  view: ViewSettings;
  liveCase: LiveCase;
  alarms: Alarms;
  sound: Sound;
  latency: Latency;
  health: ReadonlySignal<Health | null>;
  annotations: LiveAnnotations;
  comments: CommentNotices;
  study: StudyLine;
  choice: PracticeChoice;
  practice: Practice;
  practiceStore: PracticeStore;
  tutorial: Tutorial;
  feel: FeelWatch;
  result: ResultWatch;
  review: ReviewApi;
}

/** One session, live or as it was recorded: picture, force, numbers, and what can be done. */
export function LivePage(parts: LivePageParts) {
  const { store, watcher, scene, view, liveCase, alarms, sound, latency, health, practiceStore, tutorial } = parts;
  const may = useIdentity().may.value;
  const bar = store.replaying.value ? 'page-replay' : practiceStore.steering.value ? 'page-practice' : '';
  const guided = tutorial.session.value !== null && !store.replaying.value;
  const toPicture = () => scene.canvas.focus({ preventScroll: true });
  return (
    <div class={`page ${bar}`}>
      <Header store={store} study={parts.study} />
      {guided && <TutorialPanel {...{ store, tutorial }} practice={practiceStore} toPicture={toPicture} />}
      <Picture {...{ store, scene, view, alarms }} comments={parts.comments} practice={practiceStore} guided={guided}>
        <DepthMeter store={store} />
        <LiveStrip health={health} sound={sound} slicesOpen={slicesOpen} />
        {slicesOpen.value &&
          slices.show(({ LiveSlicesPanel }) => <LiveSlicesPanel store={store} liveCase={liveCase} />)}
        <ResultCard {...parts} quiet={guided} />
      </Picture>
      {store.replaying.value && <PlaybackBar store={store} player={watcher} />}
      {practiceStore.steering.value && <PracticeBar practice={practiceStore} toPicture={toPicture} />}
      <aside class={store.upToDate.value ? 'side' : 'side stale'}>
        {store.replaying.value ? <ReplayPanel store={store} watcher={watcher} /> : <RunPanel {...parts} />}
        <ProblemBanner store={store} />
        <div class="readings">
          <ForcePlots store={store} />
          <Gauges store={store} liveCase={liveCase} />
          <Figures store={store} />
        </div>
        {!store.replaying.value && <AnnotationsPanel store={store} annotations={parts.annotations} />}
        <SessionList store={store} watcher={watcher} />
        {!store.replaying.value && may.teach && (
          <HealthPanel {...{ store, latency, health }} practice={practiceStore} />
        )}
      </aside>
    </div>
  );
}
