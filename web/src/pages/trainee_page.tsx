import { useMemo } from 'preact/hooks';

import { liveText } from '../text/live_text';
import { useLiveKeys } from '../panels/picture/live_keys';
import { DepthMeter } from '../panels/live/depth_meter';
import { Picture } from '../panels/live/picture';
import { ResultCard } from '../panels/live/result_card';
import { DriveButtons, PauseButton, WithdrawButton } from '../panels/live/practice_bar';
import { StudyLine } from '../panels/live/study_line';
import { SoundButton } from '../panels/picture/sound_button';
import { addressOfReplay } from '../state/replay_address';
import { appText } from '../text/app_text';
import type { LivePageParts } from './live_page';

/** What the trainee sees: the picture as large as the window, and nothing beside it that takes time to draw. */
export function TraineePage(parts: LivePageParts) {
  const { store, watcher, scene, view, alarms, sound, practiceStore, feel } = parts;
  const theatre = view.theatre.value;
  const endsHere = practiceStore.sessionId.value !== null || feel.hidden.value !== null;
  useLiveKeys(useMemo(() => ({ f: () => void fullScreen() }), []));
  return (
    <div class="trainee-page" data-testid="trainee-page" data-theatre={theatre}>
      <Picture {...{ store, scene, view, alarms }} comments={parts.comments} practice={practiceStore} bare={true}>
        <div class="trainee-study">
          <StudyLine study={parts.study} />
        </div>
        {!theatre && <DepthMeter store={store} />}
        <div class="trainee-bar" role="group" aria-label={appText.practice}>
          {practiceStore.steering.value && <HoldButtons {...parts} />}
          <SoundButton sound={sound} />
          <button type="button" class="strip-button" aria-keyshortcuts="F" onClick={() => void fullScreen()}>
            {liveText.fullScreen}
          </button>
          {theatre ? (
            store.active.value &&
            endsHere && (
              <button
                type="button"
                class="strip-button"
                data-testid="end-theatre"
                disabled={store.busy.value}
                onClick={() => void watcher.stop()}
              >
                {liveText.endTheatre}
              </button>
            )
          ) : (
            <a class="strip-button" href={addressOfReplay(store.replayId.value) || '#'} data-testid="leave-trainee">
              {liveText.leaveTrainee}
            </a>
          )}
        </div>
        <ResultCard {...parts} />
      </Picture>
    </div>
  );
}

/** What hands without keys need; pushing is the pointer's. */
function HoldButtons({ practiceStore, scene }: LivePageParts) {
  const { hand } = practiceStore;
  const toPicture = () => scene.canvas.focus({ preventScroll: true });
  return (
    <>
      <DriveButtons hand={hand} onDone={toPicture} />
      <WithdrawButton hand={hand} onDone={toPicture} />
      <PauseButton
        hand={hand}
        onDone={() => {
          hand.takeHold();
          toPicture();
        }}
      />
    </>
  );
}

async function fullScreen(): Promise<void> {
  if (document.fullscreenElement === null) await document.documentElement.requestFullscreen().catch(() => undefined);
  else await document.exitFullscreen();
}
