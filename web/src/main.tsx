import 'uplot/dist/uPlot.min.css';
import './style.css';

import { effect, type Signal, signal } from '@preact/signals';
import { render } from 'preact';

import { publishDebugReadout } from './debug_readout';
import { App } from './pages/app';
import { BoneScene } from './scene/scene';
import { Practice } from './state/practice';
import { PracticeStore } from './state/practice_store';
import { browserWindow, letGoWhenLeft } from './state/practice_window';
import { isActive } from './state/choose_session';
import { addressOfReplay, replayInAddress } from './state/replay_address';
import { followRoute, type Route, routeInAddress } from './state/route';
import { Store } from './state/store';
import { Watcher } from './state/watcher';
import { Api } from './wire/api';
import { WorkerDeviceSocket } from './wire/device_socket';
import { WorkerStreamSocket } from './wire/stream_socket';
import { words } from './words';

function main(root: HTMLElement): void {
  const store = new Store();
  const scene = new BoneScene();
  const api = new Api(window.location.origin);
  const watcher = new Watcher(store, api, new WorkerStreamSocket(), scene);
  const practiceStore = new PracticeStore(store);
  const practice = new Practice(
    practiceStore,
    store,
    new WorkerDeviceSocket(),
    scene.canvas,
    scene,
    browserWindow(),
    (id) => api.deviceUrl(id),
  );
  letGoWhenLeft(practice);
  effect(() => scene.setToolPose(store.telemetry.value?.worldFromTool ?? null));
  effect(() => scene.setBonePose(store.telemetry.value?.worldFromBoneRest ?? null));
  effect(() => scene.setToolShown(store.reamerShown.value));
  effect(() => scene.setAim(practiceStore.plan.value, practiceStore.hand.place.value));
  publishDebugReadout(store, practiceStore, scene);
  const route = signal(routeInAddress(window.location.hash));
  render(<App route={route} live={{ store, watcher, scene, practice, practiceStore }} />, root);
  followReplayAddress(store, watcher, route);
  followRoute(route);
  const atFirst = route.value.kind === 'live' ? goOnSteering(api, store, practice) : Promise.resolve();
  void atFirst.finally(() => {
    effect(() => {
      if (route.value.kind === 'live') watcher.start();
      else if (practiceStore.sessionId.peek() !== null) practice.leave();
    });
  });
}

/** A page that was loaded anew takes its session back into the hand. */
async function goOnSteering(api: Api, store: Store, practice: Practice): Promise<void> {
  const id = practice.rememberedId();
  if (id === null || store.replayId.value !== null) return;
  const session = await api.session(id).catch(() => null);
  if (session === null || !isActive(session)) return practice.forget();
  store.sessionId.value = id;
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

const root = document.getElementById('app');
if (root !== null) {
  try {
    main(root);
  } catch {
    root.textContent = words.noWebGl;
  }
}
