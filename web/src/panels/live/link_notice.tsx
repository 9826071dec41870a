import { useEffect, useState } from 'preact/hooks';

import type { Store } from '../../state/store';
import type { LinkState } from '../../wire/link';
import { protocolRevision } from '../../wire/messages';
import { appText } from '../../text/app_text';
import { clock, sentence } from '../../text/format';

/** Over the picture, in words, whenever it is not live. */
export function LinkNotice({ store, mayReam }: { store: Store; mayReam: boolean }) {
  const link = store.link.value;
  const nowMs = useNow(link.kind === 'lost');
  const [title, text] = notice(store, link, nowMs, mayReam);
  if (title === '') return null;
  return (
    <div class={`notice notice-${link.kind}`} role="status" data-testid="link-notice">
      <p class="notice-title">{title}</p>
      {text !== '' && <p>{text}</p>}
    </div>
  );
}

function notice(store: Store, link: LinkState, nowMs: number, mayReam: boolean): [title: string, text: string] {
  switch (link.kind) {
    case 'live':
      if (store.farBehind.value) return [appText.behindTitle, appText.behindText(store.behindMs.value / 1000)];
      if (store.pictureComplete.value) return ['', ''];
      return [store.metWithLoss.value ? appText.catchingUp : appText.loading, ''];
    case 'connecting':
      return [appText.preparing, ''];
    case 'nothing':
      return [appText.nothingTitle, mayReam ? appText.nothingToMake : appText.nothingToWatch];
    case 'silent':
      return [appText.silentTitle, `${picture(store)} ${appText.waiting}`];
    case 'lost':
      if (!store.hasPicture.value)
        return [appText.neverTitle, `${sentence(link.reason)} ${retry(link.retryAtMs, nowMs)}`];
      return [appText.lostTitle, `${picture(store)} ${retry(link.retryAtMs, nowMs)}`];
    case 'refused':
      return [appText.refusedTitle, appText.refusedText(protocolRevision, link.serverRevision)];
  }
}

function picture(store: Store): string {
  const lastMs = store.lastMessageMs.value;
  return lastMs === null ? '' : appText.lastPicture(clock(lastMs));
}

function retry(retryAtMs: number | null, nowMs: number): string {
  const seconds = retryAtMs === null ? 0 : (retryAtMs - nowMs) / 1000;
  return seconds < 0.1 ? appText.retryNow : appText.retryIn(seconds);
}

/** The time, fresh a few times a second while `ticking`. */
function useNow(ticking: boolean): number {
  const [nowMs, setNowMs] = useState(Date.now());
  useEffect(() => {
    if (!ticking) return;
    setNowMs(Date.now());
    const timer = setInterval(() => setNowMs(Date.now()), 200);
    return () => clearInterval(timer);
  }, [ticking]);
  return nowMs;
}
