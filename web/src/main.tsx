import 'uplot/dist/uPlot.min.css';
import './style.css';

import { effect } from '@preact/signals';
import { render } from 'preact';

import { publishDebugReadout } from './debug_readout';
import { LivePage } from './pages/live_page';
import { BoneScene } from './scene/scene';
import { addressOfReplay, replayInAddress } from './state/replay_address';
import { Store } from './state/store';
import { Watcher } from './state/watcher';
import { Api } from './wire/api';
import { WorkerStreamSocket } from './wire/stream_socket';
import { words } from './words';

function main(root: HTMLElement): void {
  const store = new Store();
  const scene = new BoneScene();
  const watcher = new Watcher(store, new Api(window.location.origin), new WorkerStreamSocket(), scene);
  effect(() => scene.setToolPose(store.telemetry.value?.worldFromTool ?? null));
  effect(() => scene.setBonePose(store.telemetry.value?.worldFromBoneRest ?? null));
  effect(() => scene.setToolShown(store.reamerShown.value));
  publishDebugReadout(store, scene);
  render(<LivePage store={store} watcher={watcher} scene={scene} />, root);
  const named = replayInAddress(window.location.hash);
  if (named !== null) store.replayId.value = named;
  watcher.start();
  effect(() => {
    const { pathname, search } = window.location;
    window.history.replaceState(null, '', pathname + search + addressOfReplay(store.replayId.value));
  });
  window.addEventListener('hashchange', () => {
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
