import '../../styles/live_strip.css';

import type { Signal } from '@preact/signals';
import { useMemo } from 'preact/hooks';

import { liveText } from '../../text/live_text';
import type { Latency } from '../../state/latency';
import type { PracticeStore } from '../../state/practice_store';
import { addressOfRoute } from '../../state/route';
import type { Sound } from '../../state/sound';
import type { Store } from '../../state/store';
import { appText } from '../../text/app_text';
import { fixed } from '../../text/format';
import { lateAbovePercent, missedPercent } from './health_panel';
import { useLiveKeys } from '../picture/live_keys';
import { SoundButton } from '../picture/sound_button';

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
    <div class="live-strip" role="group" aria-label={liveText.strip} data-testid="live-strip">
      {!store.replaying.value && (
        <p class={slow ? 'chip chip-warn' : 'chip'} title={steering ? liveText.handDelayHint : liveText.drawDelayHint}>
          {slow && <span aria-hidden="true">▲ </span>}
          {steering ? liveText.handDelay : liveText.drawDelay}{' '}
          <strong data-testid="latency">{fixed(delayMs, 0)}</strong> ms <span class="soft">p95</span>
        </p>
      )}
      {!store.replaying.value && (
        <p class={late ? 'chip chip-warn' : 'chip'} data-testid="loop-health">
          {late && <span aria-hidden="true">▲ </span>}
          {liveText.loop}{' '}
          <strong>
            {percent === null
              ? appText.healthUnknown
              : late
                ? appText.healthLate(fixed(percent, 1))
                : appText.healthOnTime}
          </strong>
        </p>
      )}
      <p class="chip" title={liveText.forceScaleHint} data-testid="force-scale">
        {liveText.force} <strong>{fixed(store.hello.value?.forceScale, 0)} : 1</strong>
      </p>
      <SoundButton sound={sound} />
      <button
        type="button"
        class={slicesOpen.value ? 'strip-button strip-on' : 'strip-button'}
        data-testid="slices"
        aria-pressed={slicesOpen.value}
        aria-keyshortcuts="T"
        title={liveText.key(liveText.slicesHint, 'T')}
        onClick={() => (slicesOpen.value = !slicesOpen.value)}
      >
        {liveText.slices}
      </button>
      <a
        class="strip-button"
        href={addressOfRoute({ kind: 'trainee' })}
        data-testid="to-trainee"
        title={liveText.traineeViewHint}
      >
        {liveText.traineeView}
      </a>
    </div>
  );
}
