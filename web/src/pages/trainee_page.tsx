import { useMemo } from 'preact/hooks';

import { liveWords } from '../live_words';
import { useLiveKeys } from '../panels/live_keys';
import { Picture } from '../panels/picture';
import { SoundButton } from '../panels/sound_button';
import { addressOfReplay } from '../state/replay_address';
import { words } from '../words';
import type { LivePageParts } from './live_page';

/** What the trainee sees: the picture as large as the window, and nothing beside it that takes time to draw. */
export function TraineePage(parts: LivePageParts) {
  const { store, watcher, scene, view, alarms, sound, practiceStore } = parts;
  const theatre = view.theatre.value;
  useLiveKeys(useMemo(() => ({ f: () => void fullScreen() }), []));
  return (
    <div class="trainee-page" data-testid="trainee-page" data-theatre={theatre}>
      <Picture store={store} practice={practiceStore} scene={scene} view={view} alarms={alarms} bare={true}>
        <div class="trainee-bar" role="group" aria-label={words.practice}>
          {practiceStore.steering.value && <Pedals {...parts} />}
          <SoundButton sound={sound} />
          <button type="button" class="strip-button" aria-keyshortcuts="F" onClick={() => void fullScreen()}>
            {liveWords.fullScreen}
          </button>
          {theatre ? (
            store.active.value &&
            practiceStore.sessionId.value !== null && (
              <button
                type="button"
                class="strip-button"
                data-testid="end-theatre"
                disabled={store.busy.value}
                onClick={() => void watcher.stop()}
              >
                {liveWords.endTheatre}
              </button>
            )
          ) : (
            <a class="strip-button" href={addressOfReplay(store.replayId.value) || '#'} data-testid="leave-trainee">
              {liveWords.leaveTrainee}
            </a>
          )}
        </div>
      </Picture>
    </div>
  );
}

/** What hands without keys need; pushing is the pointer's. */
function Pedals({ practiceStore, scene }: LivePageParts) {
  const { hand } = practiceStore;
  const press = (act: () => void) => () => {
    hand.takeHold();
    act();
    scene.canvas.focus({ preventScroll: true });
  };
  return (
    <>
      <button
        type="button"
        class="hand-button"
        data-testid="spindle"
        aria-pressed={hand.spindleOn.value}
        onClick={press(() => hand.toggleSpindle())}
      >
        {words.spindleButton(hand.spindleOn.value)}
      </button>
      <button
        type="button"
        class="hand-button"
        data-testid="pause"
        aria-pressed={hand.paused.value}
        onClick={press(() => hand.togglePause())}
      >
        {words.pauseButton(hand.paused.value)}
      </button>
    </>
  );
}

async function fullScreen(): Promise<void> {
  if (document.fullscreenElement === null) await document.documentElement.requestFullscreen().catch(() => undefined);
  else await document.exitFullscreen();
}
