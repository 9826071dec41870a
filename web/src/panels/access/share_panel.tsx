import '../../desk.css';

import { accessWords } from '../../access_words';
import { AccessApi } from '../../wire/access_api';
import { MakeLink } from './make_link';

const api = new AccessApi(window.location.origin);

/** Lets somebody watch a session without an account. */
export function SharePanel({ session, onClose }: { session: string; onClose: () => void }) {
  return (
    <section class="share" aria-label={accessWords.share} data-testid="share-panel">
      <p class="soft">{accessWords.shareHint}</p>
      <MakeLink api={api} session={session} onMade={() => undefined} />
      <button type="button" class="plain-button" onClick={onClose}>
        {accessWords.close}
      </button>
    </section>
  );
}
