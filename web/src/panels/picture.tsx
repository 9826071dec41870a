import type { ComponentChildren } from 'preact';
import { useEffect, useRef } from 'preact/hooks';

import type { BoneScene } from '../scene/scene';
import type { ViewName } from '../scene/camera_rig';
import type { Alarms } from '../state/alarms';
import type { PracticeStore } from '../state/practice_store';
import type { Store } from '../state/store';
import type { ViewSettings } from '../state/view_settings';
import { words } from '../words';
import { AlarmList } from './alarm_list';
import { Guide } from './guide';
import { LinkNotice } from './link_notice';
import { PracticeNotice } from './practice_notice';
import { SceneTools } from './scene_tools';
import { useIdentity } from './site_nav';

const views: readonly (readonly [ViewName, string])[] = [
  ['plan', words.viewPlan],
  ['axis', words.viewAxis],
  ['side', words.viewSide],
];

interface Parts {
  store: Store;
  practice: PracticeStore;
  scene: BoneScene;
  view: ViewSettings;
  alarms: Alarms;
  /** Without the tools that change the view. */
  bare?: boolean;
  children?: ComponentChildren;
}

/** The bone and the reamer, with the view's buttons; dimmed whenever it is not live. */
export function Picture({ store, practice, scene, view, alarms, bare, children }: Parts) {
  const place = useRef<HTMLDivElement>(null);
  const may = useIdentity().may.value;
  useEffect(() => {
    const canvas = scene.canvas;
    canvas.tabIndex = 0;
    canvas.dataset.testid = 'bone-canvas';
    place.current?.prepend(canvas);
    return () => canvas.remove();
  }, [scene]);
  const steering = practice.steering.value;
  useEffect(() => {
    const { canvas } = scene;
    canvas.setAttribute('role', steering ? 'application' : 'img');
    canvas.setAttribute('aria-label', steering ? words.practiceLabel : words.sceneLabel);
    canvas.classList.toggle('steered', steering);
    if (steering) canvas.focus({ preventScroll: true });
  }, [scene, steering]);

  const stale = store.hasPicture.value && !store.upToDate.value;
  return (
    <main class={stale ? 'picture stale' : 'picture'} data-testid="picture" data-stale={stale}>
      <div class="canvas-place" ref={place} />
      {store.replaying.value && (
        <p class="replay-badge" data-testid="replay-badge">
          {words.replayBadge}
        </p>
      )}
      {steering && bare !== true && <Guide store={store} practice={practice} />}
      {steering && store.upToDate.value ? (
        <PracticeNotice store={store} practice={practice} theatre={view.theatre.value} />
      ) : (
        <LinkNotice store={store} mayReam={may.ream} />
      )}
      {!view.theatre.value && <AlarmList alarms={alarms} />}
      {children}
      {bare !== true && <ViewTools store={store} scene={scene} view={view} />}
    </main>
  );
}

function ViewTools({ store, scene, view }: Pick<Parts, 'store' | 'scene' | 'view'>) {
  return (
    <div class="views" role="group" aria-label={words.view}>
      {views.map(([name, label]) => (
        <button
          type="button"
          key={name}
          data-testid={`view-${name}`}
          onClick={() => {
            view.change({ camera: 'own' });
            scene.look(name);
          }}
        >
          {label}
        </button>
      ))}
      <SceneTools view={view} />
      <label>
        <input
          type="checkbox"
          data-testid="show-reamer"
          checked={store.reamerShown.value}
          onChange={(event) => (store.reamerShown.value = event.currentTarget.checked)}
        />
        {words.showReamer}
      </label>
    </div>
  );
}
