import type { PracticeStore } from '../state/practice_store';
import type { Store } from '../state/store';
import { words } from '../words';

type Look = 'plain' | 'silent' | 'lost';
type Notice = readonly [look: Look, title: string, text: string];

interface Parts {
  store: Store;
  practice: PracticeStore;
  /** In theatre nobody is told how deep it is. */
  theatre: boolean;
}

/** Over the picture, in words, whenever the hand does not do what the person may think it does. */
export function PracticeNotice({ store, practice, theatre }: Parts) {
  const notice = ofLink(practice) ?? ofHand(store, practice, theatre);
  if (notice === null) return null;
  const [look, title, text] = notice;
  return (
    <div class={`notice notice-${look}`} role="status" data-testid="practice-notice">
      <p class="notice-title">{title}</p>
      {text !== '' && <p>{text}</p>}
    </div>
  );
}

function ofLink(practice: PracticeStore): Notice | null {
  const link = practice.link.value;
  switch (link.kind) {
    case 'connecting':
      return ['plain', words.noticeHandConnecting, ''];
    case 'silent':
      return ['silent', words.noticeHandSilent, words.waiting];
    case 'lost':
      return ['lost', words.noticeHandLost, `${words.noticeHandLostText} ${words.retryNow}`];
    case 'ended':
      return null;
    case 'holding':
      if (practice.feedback.value?.link === 'fading') return ['silent', words.noticeHandFading, ''];
      if (practice.feedback.value?.link === 'lost') return ['lost', words.noticeHandPoseLost, ''];
      return null;
  }
}

function ofHand(store: Store, practice: PracticeStore, theatre: boolean): Notice | null {
  const { hand } = practice;
  if (!hand.held.value) return ['silent', words.noticeLetGo, words.noticeLetGoText];
  if (hand.paused.value) return ['plain', words.noticePaused, words.noticePausedText];
  const pushing = hand.pushN.value > 0;
  if (pushing && !hand.spindleOn.value && (practice.feedback.value?.engaged ?? false))
    return ['silent', words.noticeSpindleOff, words.noticeSpindleOffText];
  if (theatre) return null;
  const plannedMm = store.hello.value?.plannedDepthMm ?? 0;
  if (pushing && plannedMm > 0 && (store.reading.value.told?.depthMm ?? 0) >= plannedMm)
    return ['lost', words.noticeDepth, words.noticeDepthText];
  return null;
}
