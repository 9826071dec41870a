import 'uplot/dist/uPlot.min.css';
import './style.css';

import { effect } from '@preact/signals';
import { render } from 'preact';

import { publishDebugReadout } from './debug_readout';
import { LivePage } from './pages/live_page';
import { BoneScene } from './scene/scene';
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
  watcher.start();
}

const root = document.getElementById('app');
if (root !== null) {
  try {
    main(root);
  } catch {
    root.textContent = words.noWebGl;
  }
}
