import { useEffect, useRef } from 'preact/hooks';

import type { BoneScene } from '../scene/scene';
import type { ViewName } from '../scene/camera_rig';
import type { PracticeStore } from '../state/practice_store';
import type { Store } from '../state/store';
import { words } from '../words';
import { Guide } from './guide';
import { LinkNotice } from './link_notice';
import { PracticeNotice } from './practice_notice';
import { useIdentity } from './site_nav';

const views: readonly (readonly [ViewName, string])[] = [
  ['plan', words.viewPlan],
  ['axis', words.viewAxis],
  ['side', words.viewSide],
];

/** The bone and the reamer, with the view's buttons; dimmed whenever it is not live. */
export function Picture({ store, practice, scene }: { store: Store; practice: PracticeStore; scene: BoneScene }) {
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
      {steering && <Guide store={store} practice={practice} />}
      {steering && store.upToDate.value ? (
        <PracticeNotice store={store} practice={practice} />
      ) : (
        <LinkNotice store={store} mayReam={may.ream} />
      )}
      <div class="views" role="group" aria-label={words.view}>
        {views.map(([view, label]) => (
          <button type="button" key={view} data-testid={`view-${view}`} onClick={() => scene.look(view)}>
            {label}
          </button>
        ))}
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
    </main>
  );
}
