import type { PracticeStore } from '../../state/practice_store';
import type { Store } from '../../state/store';
import { appText } from '../../text/app_text';

type Look = 'plain' | 'silent' | 'lost';
type Notice = readonly [look: Look, title: string, text: string];

interface Parts {
  store: Store;
  practice: PracticeStore;
}

/** Over the picture, in words, whenever the hand does not do what the person may think it does. */
export function PracticeNotice({ store, practice }: Parts) {
  const notice = ofLink(practice) ?? ofHand(store, practice);
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
      return ['plain', appText.noticeHandConnecting, ''];
    case 'silent':
      return ['silent', appText.noticeHandSilent, appText.waiting];
    case 'lost':
      return ['lost', appText.noticeHandLost, `${appText.noticeHandLostText} ${appText.retryNow}`];
    case 'ended':
      return null;
    case 'holding':
      if (practice.feedback.value?.link === 'fading') return ['silent', appText.noticeHandFading, ''];
      if (practice.feedback.value?.link === 'lost') return ['lost', appText.noticeHandPoseLost, ''];
      return null;
  }
}

function ofHand(store: Store, practice: PracticeStore): Notice | null {
  const { hand } = practice;
  if (!hand.held.value) return ['silent', appText.noticeLetGo, appText.noticeLetGoText];
  if (hand.paused.value) return ['plain', appText.noticePaused, appText.noticePausedText];
  const pushing = hand.pushN.value > 0;
  if (pushing && !hand.spindleOn.value && (practice.feedback.value?.engaged ?? false))
    return ['silent', appText.noticeSpindleOff, appText.noticeSpindleOffText];
  if (store.reading.value.telemetry?.stalled === true)
    return ['silent', appText.noticeStalled, appText.noticeStalledText];
  if (!practice.hints.value) return null;
  const plannedMm = store.hello.value?.plannedDepthMm ?? 0;
  if (pushing && plannedMm > 0 && (store.reading.value.telemetry?.depthMm ?? 0) >= plannedMm)
    return ['lost', appText.noticeDepth, appText.noticeDepthText];
  return null;
}
