import { useMemo } from 'preact/hooks';

import { liveText } from '../../text/live_text';
import type { Sound } from '../../state/sound';
import { useLiveKeys } from './live_keys';

/** The sound of the reamer, off until it is asked for. */
export function SoundButton({ sound }: { sound: Sound }) {
  const toggle = () => void sound.toggle();
  useLiveKeys(useMemo(() => ({ m: toggle }), [sound]));
  const on = sound.on.value;
  return (
    <button
      type="button"
      class={on ? 'strip-button strip-on' : 'strip-button'}
      data-testid="sound"
      data-on={on}
      aria-keyshortcuts="M"
      title={sound.problem.value ?? liveText.key(liveText.soundHint, 'M')}
      onClick={toggle}
    >
      {sound.problem.value !== null ? liveText.noSoundShort : liveText.soundButton(on)}
    </button>
  );
}
