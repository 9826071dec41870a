import './live_strip.css';

import type { Signal } from '@preact/signals';
import { useMemo } from 'preact/hooks';

import { liveWords } from '../live_words';
import type { Latency } from '../state/latency';
import type { PracticeStore } from '../state/practice_store';
import { addressOfRoute } from '../state/route';
import type { Sound } from '../state/sound';
import type { Store } from '../state/store';
import { words } from '../words';
import { fixed } from './format';
import { lateAbovePercent, missedPercent } from './health_panel';
import { useLiveKeys } from './live_keys';
import { SoundButton } from './sound_button';

/** What the picture should take at most, ms. */
const latencyGoalMs = 100;

interface Parts {
  store: Store;
  practice: PracticeStore;
  latency: Latency;
  sound: Sound;
  slicesOpen: Signal<boolean>;
}

/** Always in sight: how late the picture is, whether the loop keeps its time, and the scale of the force. */
export function LiveStrip({ store, practice, latency, sound, slicesOpen }: Parts) {
  useLiveKeys(useMemo(() => ({ t: () => (slicesOpen.value = !slicesOpen.value) }), [slicesOpen]));
  const live = store.live.value;
  const steering = practice.steering.value;
  const drawingMs = latency.drawingMs.value;
  const watchingMs = drawingMs === null ? null : drawingMs + store.reading.value.behindMs;
  const delayMs = !live ? null : steering ? latency.handMs.value : watchingMs;
  const slow = delayMs !== null && delayMs > latencyGoalMs;
  const percent = live ? missedPercent(store) : null;
  const late = percent !== null && percent > lateAbovePercent;
  return (
    <div class="live-strip" role="group" aria-label={liveWords.strip} data-testid="live-strip">
      {!store.replaying.value && (
        <p
          class={slow ? 'chip chip-warn' : 'chip'}
          title={steering ? liveWords.handDelayHint : liveWords.drawDelayHint}
        >
          {slow && <span aria-hidden="true">▲ </span>}
          {steering ? liveWords.handDelay : liveWords.drawDelay}{' '}
          <strong data-testid="latency">{fixed(delayMs, 0)}</strong> ms <span class="soft">p95</span>
        </p>
      )}
      {!store.replaying.value && (
        <p class={late ? 'chip chip-warn' : 'chip'} data-testid="loop-health">
          {late && <span aria-hidden="true">▲ </span>}
          {liveWords.loop}{' '}
          <strong>
            {percent === null ? words.healthUnknown : late ? words.healthLate(fixed(percent, 1)) : words.healthOnTime}
          </strong>
        </p>
      )}
      <p class="chip" title={liveWords.forceScaleHint} data-testid="force-scale">
        {liveWords.force} <strong>{fixed(store.hello.value?.forceScale, 0)} : 1</strong>
      </p>
      <SoundButton sound={sound} />
      <button
        type="button"
        class={slicesOpen.value ? 'strip-button strip-on' : 'strip-button'}
        data-testid="slices"
        aria-pressed={slicesOpen.value}
        aria-keyshortcuts="T"
        title={liveWords.key(liveWords.slicesHint, 'T')}
        onClick={() => (slicesOpen.value = !slicesOpen.value)}
      >
        {liveWords.slices}
      </button>
      <a
        class="strip-button"
        href={addressOfRoute({ kind: 'trainee' })}
        data-testid="to-trainee"
        title={liveWords.traineeViewHint}
      >
        {liveWords.traineeView}
      </a>
    </div>
  );
}
