import type { ComponentChildren } from 'preact';
import { useEffect, useRef } from 'preact/hooks';

import type { BoneScene } from '../../scene/scene';
import type { Alarms } from '../../state/alarms';
import type { CommentNotices as Notices } from '../../state/comment_notices';
import type { PracticeStore } from '../../state/practice_store';
import type { Store } from '../../state/store';
import type { ViewSettings } from '../../state/view_settings';
import { appText } from '../../text/app_text';
import { AlarmList } from './alarm_list';
import { CommentNotices } from './comment_notices';
import { ControlsOnly, Guide } from './guide';
import { LinkNotice } from './link_notice';
import { PracticeNotice } from './practice_notice';
import { useIdentity } from '../common/site_nav';
import { ViewTools } from '../picture/view_tools';
import { Button } from '../common/button';

interface Parts {
  store: Store;
  practice: PracticeStore;
  scene: BoneScene;
  view: ViewSettings;
  alarms: Alarms;
  /** Without the tools that change the view. */
  bare?: boolean;
  /** A tutorial says what to do. */
  guided?: boolean;
  comments: Notices;
  children?: ComponentChildren;
}

/** The bone and the reamer, with the view's buttons; dimmed whenever it is not live. */
export function Picture({ store, practice, scene, view, alarms, bare, guided, comments, children }: Parts) {
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
    canvas.setAttribute('aria-label', steering ? appText.practiceLabel : appText.sceneLabel);
    canvas.classList.toggle('steering', steering);
    if (steering) canvas.focus({ preventScroll: true });
  }, [scene, steering]);

  const lost = scene.lost.value;
  const stale = store.hasPicture.value && (lost || !store.upToDate.value);
  return (
    <main
      class={`picture${stale ? ' stale' : ''}${lost ? ' picture-lost' : ''}`}
      data-testid="picture"
      data-stale={stale}
    >
      <div class="canvas-place" ref={place} />
      {store.replaying.value && (
        <p class="replay-badge" data-testid="replay-badge">
          {appText.replayBadge}
        </p>
      )}
      {steering && practice.hints.value && bare !== true && guided !== true && (
        <Guide store={store} practice={practice} />
      )}
      {steering && !practice.hints.value && bare !== true && guided !== true && <ControlsOnly />}
      {lost && store.upToDate.value ? (
        <PictureLost steering={steering} />
      ) : steering && store.upToDate.value ? (
        <PracticeNotice store={store} practice={practice} />
      ) : (
        <LinkNotice store={store} mayReam={may.ream} />
      )}
      {!view.theatre.value && practice.hints.value && <AlarmList alarms={alarms} />}
      <CommentNotices notices={comments} toPicture={() => scene.canvas.focus({ preventScroll: true })} />
      {children}
      {bare !== true && <ViewTools scene={scene} view={view} reamerShown={store.reamerShown} />}
    </main>
  );
}

/** Nothing that was drawn before is seen meanwhile. */
function PictureLost({ steering }: { steering: boolean }) {
  return (
    <div class="notice notice-lost" role="alert" data-testid="picture-lost">
      <p class="notice-title">{appText.pictureLostTitle}</p>
      <p>
        {appText.pictureLost} {steering && appText.pictureLostSteering}
      </p>
      <Button onClick={() => window.location.reload()}>{appText.reload}</Button>
    </div>
  );
}
