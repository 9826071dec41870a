import 'uplot/dist/uPlot.min.css';
import './styles/base.css';
import './styles/forms.css';
import './styles/outcome.css';

import { computed, effect, type Signal, signal, untracked } from '@preact/signals';
import { render } from 'preact';

import { publishDebugReadout } from './debug_readout';
import { App } from './pages/app';
import { BoneScene } from './scene/scene';
import { Alarms } from './state/alarms';
import { healthHere } from './state/health';
import { Identity } from './state/identity';
import { Latency } from './state/latency';
import { LiveCase } from './state/live_case';
import { LiveAnnotations } from './state/live_annotations';
import { Practice } from './state/practice';
import { PracticeChoice } from './state/practice_choice';
import { PracticeStore } from './state/practice_store';
import { browserWindow, letGoWhenLeft } from './state/practice_window';
import { headsetMessage } from './scene/headset_text';
import { CommentNotices } from './state/comment_notices';
import { isActive } from './state/choose_session';
import { followTitle } from './state/page_title';
import { addressOfReplay, replayInAddress } from './state/replay_address';
import { addressOfRoute, followRoute, type Route, routeInAddress, showsSession } from './state/route';
import { layReamerAside } from './state/reamer_at_end';
import { ResultWatch } from './state/result_watch';
import { Sound } from './state/sound';
import { Store } from './state/store';
import { type InStudy, StudyLine } from './state/study/study_line';
import { FeelWatch } from './state/study/feel_watch';
import { theatreHere } from './state/theatre';
import { theme } from './state/theme';
import { toolAction } from './state/tool_action';
import { Tutorial, type TutorialParts } from './state/tutorial_guide';
import { ViewSettings } from './state/view_settings';
import { linkInAddress, takeLinkFromAddress } from './state/watch_link';
import { Surroundings } from './state/surroundings';
import { Watcher } from './state/watcher';
import { Api } from './wire/api';
import { ChangeSocket } from './wire/change_socket';
import { CaseApi } from './wire/case_api';
import { WorkerDeviceSocket } from './wire/device_socket';
import { LoginApi } from './wire/login_api';
import { MeshLoader } from './wire/mesh_loader';
import { ReviewApi } from './wire/review_api';
import { WorkerStreamSocket } from './wire/stream_socket';
import { StudyApi } from './wire/study_api';
import { appText } from './text/app_text';

function main(root: HTMLElement): void {
  const linkSecret = takeLinkFromAddress();
  const identity = new Identity(new LoginApi(window.location.origin), () => window.location.reload());
  const store = new Store();
  const route = signal(routeInAddress(window.location.hash));
  const scene = new BoneScene();
  const api = new Api(window.location.origin);
  const watcher = new Watcher(store, api, new WorkerStreamSocket(scene.inSoftware), scene, {
    makesSession: () => !identity.hasUsers.value,
  });
  const practiceStore = new PracticeStore(store);
  const practice = steerByHand(practiceStore, store, scene, api);
  const liveCase = new LiveCase(store, () => identity.may.value.readCases, window.location.origin);
  const seesSurroundings = () => identity.may.value.readCases && scene.quality.full.value;
  new Surroundings(store, scene, new MeshLoader(), seesSurroundings, window.location.origin);
  const alarms = new Alarms(store);
  const sound = new Sound(store, async () => (await import('./sound/sound_output')).SoundOutput.open());
  const latency = measureLatency(store, practiceStore, scene);
  publishDebugReadout({ store, practice: practiceStore, scene, sound, latency });
  const view = new ViewSettings();
  keepOwnCamera(scene, view);
  const inTheatre = theatreHere(store, practiceStore, route);
  effect(() => void (view.theatre.value = inTheatre.value));
  effect(() => scene.setView(view.shown.value, view.theatre.value));
  const tutorial = makeTutorial({ store, watcher, practice, practiceStore }, scene, view);
  const choice = new PracticeChoice(new CaseApi(window.location.origin), () => identity.may.value.readCases);
  keepForPerson(identity, [view, choice], tutorial);
  const review = new ReviewApi(window.location.origin);
  const annotations = new LiveAnnotations(
    store,
    review,
    (handlers) => new ChangeSocket(window.location.origin, handlers),
  );
  const comments = noticeComments(identity, { store, practice: practiceStore, annotations });
  showReamer(store, scene, comments);
  const feel = watchForFeel(identity, { store, practice: practiceStore, route });
  effect(() => scene.setAim(practiceStore.plan.value, practiceStore.hand.place.value));
  render(
    <App
      route={route}
      live={{
        store,
        watcher,
        scene,
        view,
        liveCase,
        alarms,
        sound,
        latency,
        health: healthHere(store, practiceStore, latency),
        annotations,
        comments,
        study: studyLine(store, api, identity),
        choice,
        practice,
        practiceStore,
        tutorial,
        feel,
        result: watchForResult(store, review, feel),
        review,
      }}
      identity={identity}
    />,
    root,
  );
  followReplayAddress(store, watcher, route);
  followViewerLinks(identity);
  followRoute(route);
  followTitle({ route, loggedOut: () => identity.phase.value === 'unknown' }, document);
  beginWithOverview(identity, route);
  void identity.find(linkSecret);
  watchWhenKnown(identity, route, () => goOnSteering(api, store, practice), { watcher, practice, practiceStore });
}

/** Mouse, touch, keys and gamepad of this window; they let go when nothing is seen. */
function steerByHand(practiceStore: PracticeStore, store: Store, scene: BoneScene, api: Api): Practice {
  const hands = browserWindow();
  const practice = new Practice(
    practiceStore,
    store,
    new WorkerDeviceSocket(),
    scene.canvas,
    scene,
    // Nobody reams what they do not see.
    { ...hands, attended: () => hands.attended() && !scene.lost.value },
    (id) => api.deviceUrl(id),
  );
  letGoWhenLeft(practice);
  practiceStore.input.listen(window, window.matchMedia('(pointer: coarse)').matches);
  effect(() => {
    if (scene.lost.value && practiceStore.sessionId.peek() !== null) untracked(() => practice.letGo());
  });
  return practice;
}

/** A camera that a person has moved is their own. */
function keepOwnCamera(scene: BoneScene, view: ViewSettings): void {
  scene.onInteraction = () => {
    if (view.camera.peek() !== 'own') view.change({ camera: 'own' });
  };
}

/** Where the reamer and the bone are, and what the reamer does. */
function showReamer(store: Store, scene: BoneScene, comments: CommentNotices): void {
  effect(() => scene.setToolPose(store.telemetry.value?.worldFromTool ?? null));
  effect(() => scene.setBonePose(store.telemetry.value?.worldFromBoneRest ?? null));
  effect(() => scene.setToolAction(toolAction(store.telemetry.value, store.upToDate.value)));
  effect(() => scene.setTouching(store.touching.value));
  effect(() => {
    if (scene.headset.worn.value) {
      scene.headset.show(headsetMessage(store, comments.shown.value.at(-1)?.comment ?? null));
    }
  });
  layReamerAside(store);
  effect(() => scene.setToolShown(store.reamerShown.value));
}

/** Who takes part in a study signs comments by its code. */
function noticeComments(
  identity: Identity,
  watched: { store: Store; practice: PracticeStore; annotations: LiveAnnotations },
): CommentNotices {
  const ownNames = () => {
    const { user } = identity.visitor.peek() ?? {};
    const code = watched.store.watched.peek()?.participant ?? '';
    return [user?.name ?? '', user?.display_name ?? '', code];
  };
  return new CommentNotices({ ...watched, ownNames });
}

function studyLine(store: Store, api: Api, identity: Identity): StudyLine {
  const studies = new StudyApi(window.location.origin);
  // A viewer may list only the session of the link.
  const earlier = async (session: InStudy) => (identity.may.peek().ream ? await api.earlierInStudy(session) : null);
  return new StudyLine({ store, study: (id) => studies.study(id), earlier });
}

function watchForFeel(
  identity: Identity,
  watched: { store: Store; practice: PracticeStore; route: Signal<Route> },
): FeelWatch {
  const studies = new StudyApi(window.location.origin);
  return new FeelWatch({ ...watched, may: () => identity.may.value, study: (id) => studies.study(id) });
}

/** Of what a study of feel hides, not even the score is asked for. */
function watchForResult(store: Store, review: ReviewApi, feel: FeelWatch): ResultWatch {
  const hidden = computed(() => feel.hidden.value !== null);
  return new ResultWatch({ store, score: (id) => review.score(id), hidden });
}

/** Who teaches and logs in begins the day with the overview, unless the address names a page. */
function beginWithOverview(identity: Identity, route: Signal<Route>): void {
  let hadToLogIn = false;
  let begun = false;
  effect(() => {
    const phase = identity.phase.value;
    if (phase === 'unknown') hadToLogIn = true;
    if (phase !== 'known' || begun) return;
    begun = true;
    if (!hadToLogIn || !identity.may.peek().teach || window.location.hash !== '') return;
    window.history.replaceState(null, '', addressOfRoute({ kind: 'dashboard' }));
    route.value = { kind: 'dashboard' };
  });
}

/** Nothing is watched and nothing steered before it is known who uses the page, and from when that has ended. */
function watchWhenKnown(
  identity: Identity,
  route: Signal<Route>,
  goOn: () => Promise<void>,
  { watcher, practice, practiceStore }: { watcher: Watcher; practice: Practice; practiceStore: PracticeStore },
): void {
  let begun = false;
  effect(() => {
    const known = identity.phase.value === 'known';
    const live = showsSession(route.value);
    if (!known || !live) {
      if (practiceStore.sessionId.peek() !== null) practice.leave();
      if (!known) watcher.rest();
      return;
    }
    const first = !begun && identity.may.peek().ream;
    begun = true;
    void (first ? goOn() : Promise.resolve()).finally(() => {
      if (identity.phase.peek() === 'known') watcher.start();
    });
  });
}

/** By this computer's clock alone, ms since 1970: page and workers count from different moments. */
const clockMs = () => performance.timeOrigin + performance.now();
const publishLatencyMs = 500;

function measureLatency(store: Store, practice: PracticeStore, scene: BoneScene): Latency {
  const latency = new Latency();
  const session = computed(() => store.hello.value?.sessionId);
  session.subscribe(() => latency.forget());
  effect(() => {
    const feedback = practice.feedback.value;
    if (feedback !== null && feedback.sentMs !== null) latency.taken({ sentMs: feedback.sentMs, tick: feedback.tick });
  });
  scene.onDrawn = () => {
    const telemetry = store.telemetry.peek();
    if (telemetry?.receivedMs === undefined || !store.live.peek()) return;
    latency.drawn(telemetry.tick, telemetry.receivedMs, clockMs());
  };
  store.telemetry.subscribe((telemetry) => {
    if (telemetry === null) return;
    // Once the scene has followed the same message.
    queueMicrotask(() => {
      if (!scene.waitsToDraw) latency.shows(telemetry.tick);
    });
  });
  setInterval(() => latency.publish(clockMs()), publishLatencyMs);
  return latency;
}

function makeTutorial(parts: Omit<TutorialParts, 'view'>, scene: BoneScene, view: ViewSettings): Tutorial {
  const begin = () => {
    view.ownForNow.value = true;
    scene.look('plan');
  };
  const end = () => (view.ownForNow.value = false);
  return new Tutorial({ ...parts, view: { eye: () => scene.eye(), begin, end } });
}

/** How somebody wants to see the bone and to practise, and who knows the tutorial; without users all are the browser's. */
function keepForPerson(identity: Identity, kept: readonly [ViewSettings, PracticeChoice], tutorial: Tutorial): void {
  let ends: readonly (() => void)[] = [];
  effect(() => {
    const person = identity.userId.value ?? 'anyone';
    for (const end of ends) end();
    ends = untracked(() => kept.map((one) => one.keepFor(person, window.localStorage)));
    untracked(() => tutorial.keepFor(person, window.localStorage));
  });
}

/** A viewer link that is opened where the page is open already. */
function followViewerLinks(identity: Identity): void {
  window.addEventListener('hashchange', () => {
    if (linkInAddress(window.location.hash) === null) return;
    const secret = takeLinkFromAddress();
    if (secret !== null) void identity.useLink(secret);
  });
}

/** A page that was loaded anew takes its session back into the hand. */
async function goOnSteering(api: Api, store: Store, practice: Practice): Promise<void> {
  const id = practice.rememberedId();
  if (id === null || store.replayId.value !== null) return;
  const session = await api.session(id).catch(() => null);
  if (session === null || !isActive(session)) return practice.forget();
  store.sessionId.value = id;
  store.details.value = session;
  practice.steer(id);
}

/** The address of the live page names the replay that is watched, and the other way round. */
function followReplayAddress(store: Store, watcher: Watcher, route: Signal<Route>): void {
  const named = replayInAddress(window.location.hash);
  if (named !== null) store.replayId.value = named;
  effect(() => {
    const replayId = store.replayId.value;
    if (route.value.kind !== 'live') return;
    const { pathname, search } = window.location;
    window.history.replaceState(null, '', pathname + search + addressOfReplay(replayId));
  });
  window.addEventListener('hashchange', () => {
    if (routeInAddress(window.location.hash).kind !== 'live') return;
    const replayId = replayInAddress(window.location.hash);
    if (replayId === null) watcher.leaveReplay();
    else watcher.watchReplay(replayId);
  });
}

theme.begin(window.localStorage, window.matchMedia('(prefers-color-scheme: dark)'), (shown) => {
  document.documentElement.dataset.theme = shown;
});
const root = document.getElementById('app');
if (root !== null) {
  try {
    main(root);
  } catch {
    root.textContent = appText.noWebGl;
  }
}
