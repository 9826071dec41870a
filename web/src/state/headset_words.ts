import { fixed, minutes } from '../panels/format';
import type { HeadsetWords } from '../scene/headset';
import { liveWords } from '../live_words';
import type { Store } from './store';

/** What the wearer of a headset reads: the work's figures, and whether what is seen is of this moment. */
export function headsetWords(store: Store): HeadsetWords {
  const hello = store.hello.value;
  if (hello === null || !store.upToDate.value) return { text: liveWords.headsetNotLive, warns: true };
  const told = store.telemetry.value;
  const figures = [
    `${fixed(told?.thrustN.at(-1), 0)} N`,
    liveWords.headsetDepth(fixed(told?.depthMm, 1), fixed(hello.plannedDepthMm, 1)),
  ].join('   ');
  if (!store.replaying.value) return { text: `${liveWords.headsetLive}   ${figures}`, warns: false };
  const at = minutes((store.playback.value?.positionTicks ?? 0) / 1000);
  return { text: `${liveWords.headsetRecorded} ${at}   ${figures}`, warns: false };
}
