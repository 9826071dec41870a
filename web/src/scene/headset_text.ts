import { fixed, minutes } from '../text/format';
import { practiceText } from '../text/practice_text';
import type { Annotation } from '../wire/rest_types';
import type { HeadsetMessage } from './headset';
import { liveText } from '../text/live_text';
import type { Store } from '../state/store';

/** What the wearer of a headset reads: the work's figures, and whether what is seen is of this moment. */
export function headsetMessage(store: Store, comment: Annotation | null = null): HeadsetMessage {
  const hello = store.hello.value;
  if (hello === null || !store.upToDate.value) return { text: liveText.headsetNotLive, warns: true };
  if (comment !== null) return { text: commentText(comment), warns: false };
  const telemetry = store.telemetry.value;
  const figures = [
    `${fixed(telemetry?.thrustN.at(-1), 0)} N`,
    liveText.headsetDepth(fixed(telemetry?.depthMm, 1), fixed(hello.plannedDepthMm, 1)),
  ].join('   ');
  if (!store.replaying.value) return { text: `${liveText.headsetLive}   ${figures}`, warns: false };
  const at = minutes((store.playback.value?.positionTicks ?? 0) / 1000);
  return { text: `${liveText.headsetRecorded} ${at}   ${figures}`, warns: false };
}

/** More cannot be read in one line. */
const commentMost = 60;

function commentText({ author, words }: Annotation): string {
  const text = `${author === '' ? practiceText.comment : practiceText.commentBy(author)} ${words}`;
  return text.length <= commentMost ? text : `${text.slice(0, commentMost - 1)}…`;
}
