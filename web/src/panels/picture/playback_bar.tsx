import type { ComponentChildren } from 'preact';

import type { Player } from '../../state/player';
import type { Store } from '../../state/store';
import type { Mark } from '../../wire/rest_types';
import { appText } from '../../text/app_text';
import { minutes } from '../../text/format';

const speeds = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16];
/** A tick, so that any moment and the very end can be reached; arrow keys go further. */
const sliderStepS = 0.001;
const keyStepS = 1;

interface Parts {
  store: Store;
  player: Player;
  /** In place of the recording's own. */
  marks?: readonly Mark[];
  /** Above the slider, as long as it. */
  children?: ComponentChildren;
}

/** Where the replay stands, and the ways to another moment. */
export function PlaybackBar({ store, player, marks = store.marks.value, children }: Parts) {
  const playback = store.playback.value;
  const durationS = (store.hello.value?.durationTicks ?? 0) / 1000;
  const positionS = player.scrubber.wantedS.value ?? (playback?.positionTicks ?? 0) / 1000;
  const playing = playback?.playing ?? false;
  const usable = playback !== null && store.link.value.kind === 'live';
  return (
    <section class="playback" aria-label={appText.playback} data-testid="playback">
      <button
        type="button"
        class="play-button"
        data-testid="play"
        data-playing={playing}
        disabled={!usable}
        onClick={() => void player.play({ playing: !playing })}
      >
        {playing ? appText.rest : appText.play}
      </button>
      <div class="timeline">
        {children}
        <input
          type="range"
          data-testid="seek"
          aria-label={appText.moment}
          aria-valuetext={appText.momentOf(minutes(positionS), minutes(durationS))}
          min={0}
          max={durationS}
          step={sliderStepS}
          value={positionS}
          disabled={!usable}
          onKeyDown={(event) => {
            const steps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
            if (steps === undefined) return;
            event.preventDefault();
            player.scrubber.seek(Math.min(Math.max(positionS + steps * keyStepS, 0), durationS));
          }}
          onInput={(event) => player.scrubber.seek(Math.min(event.currentTarget.valueAsNumber, durationS))}
        />
        <div class="marks">
          {marks.map((mark, i) => (
            <MarkButton key={i} mark={mark} durationS={durationS} player={player} />
          ))}
        </div>
      </div>
      <p class="playback-time" data-testid="playback-time">
        {minutes(positionS)} <span class="soft">/ {minutes(durationS)}</span>
      </p>
      <label class="speed">
        {appText.speed}{' '}
        <select
          data-testid="speed"
          disabled={!usable}
          onChange={(event) => void player.play({ speed: Number(event.currentTarget.value) })}
        >
          {speeds.map((speed) => (
            <option key={speed} value={speed} selected={Math.abs(speed - (playback?.speed ?? 1)) < 1e-6}>
              {speed}×
            </option>
          ))}
        </select>
      </label>
    </section>
  );
}

function MarkButton({ mark, durationS, player }: { mark: Mark; durationS: number; player: Player }) {
  const at = durationS > 0 ? Math.min(mark.at_s / durationS, 1) : 0;
  const title = `${minutes(mark.at_s)} ${appText.mark(mark.kind)}${mark.words === '' ? '' : `: ${mark.words}`}`;
  return (
    <button
      type="button"
      class={`mark mark-${mark.kind}`}
      data-testid="mark"
      style={{ left: `${(at * 100).toFixed(3)}%` }}
      title={title}
      aria-label={title}
      onClick={() => player.scrubber.seek(Math.min(mark.at_s, durationS))}
    />
  );
}
