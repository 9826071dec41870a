import '../../styles/live_strip.css';

import type { ReadonlySignal, Signal } from '@preact/signals';
import { useMemo } from 'preact/hooks';

import { healthText } from '../../text/health_text';
import { liveText } from '../../text/live_text';
import type { Health } from '../../state/health';
import { addressOfRoute } from '../../state/route';
import type { Sound } from '../../state/sound';
import { useLiveKeys } from '../picture/live_keys';
import { SoundButton } from '../picture/sound_button';

interface Parts {
  health: ReadonlySignal<Health | null>;
  sound: Sound;
  slicesOpen: Signal<boolean>;
}

/** Always in sight: whether the simulation keeps up, the sound, and other pictures of the same. */
export function LiveStrip({ health, sound, slicesOpen }: Parts) {
  useLiveKeys(useMemo(() => ({ t: () => (slicesOpen.value = !slicesOpen.value) }), [slicesOpen]));
  return (
    <div class="live-strip" role="group" aria-label={healthText.strip} data-testid="live-strip">
      <HealthDot health={health} />
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

/** One state, and a sentence of advice where something is wrong. */
function HealthDot({ health }: Pick<Parts, 'health'>) {
  const now = health.value;
  return (
    <p class={`chip health-dot health-${now?.state ?? 'none'}`} role="status" data-testid="health-dot">
      {now !== null && (
        <>
          <span class="health-sign" aria-hidden="true">
            {{ ok: '●', slow: '▲', lost: '⬣' }[now.state]}
          </span>
          <span>
            <strong>{healthText.state[now.state]}</strong>
            {now.cause !== null && <span class="health-advice">{healthText.advice[now.cause]}</span>}
          </span>
        </>
      )}
    </p>
  );
}
