import { useEffect, useState } from 'preact/hooks';

import type { Store } from '../state/store';
import type { LinkState } from '../wire/link';
import { protocolRevision } from '../wire/messages';
import { words } from '../words';
import { clock, sentence } from './format';

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
      if (store.farBehind.value) return [words.behindTitle, words.behindText(store.behindMs.value / 1000)];
      if (store.pictureComplete.value) return ['', ''];
      return [store.metWithLoss.value ? words.catchingUp : words.loading, ''];
    case 'connecting':
      return [words.preparing, ''];
    case 'nothing':
      return [words.nothingTitle, mayReam ? words.nothingToMake : words.nothingToWatch];
    case 'silent':
      return [words.silentTitle, `${picture(store)} ${words.waiting}`];
    case 'lost':
      if (!store.hasPicture.value)
        return [words.neverTitle, `${sentence(link.reason)} ${retry(link.retryAtMs, nowMs)}`];
      return [words.lostTitle, `${picture(store)} ${retry(link.retryAtMs, nowMs)}`];
    case 'refused':
      return [words.refusedTitle, words.refusedText(protocolRevision, link.serverRevision)];
  }
}

function picture(store: Store): string {
  const lastMs = store.lastMessageMs.value;
  return lastMs === null ? '' : words.lastPicture(clock(lastMs));
}

function retry(retryAtMs: number | null, nowMs: number): string {
  const seconds = retryAtMs === null ? 0 : (retryAtMs - nowMs) / 1000;
  return seconds < 0.1 ? words.retryNow : words.retryIn(seconds);
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
