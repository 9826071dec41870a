import '../../styles/pages.css';

import { accessText } from '../../text/access_text';
import { AccessApi } from '../../wire/access_api';
import { MakeLink } from './make_link';

const api = new AccessApi(window.location.origin);

interface Parts {
  session: string;
  /** The link leads to the session's review. */
  review?: boolean;
  onClose: () => void;
}

/** Lets somebody watch a session without an account. */
export function SharePanel({ session, review, onClose }: Parts) {
  return (
    <section class="share" aria-label={accessText.share} data-testid="share-panel">
      <p class="soft">{accessText.shareHint}</p>
      <MakeLink api={api} session={session} review={review === true} onMade={() => undefined} />
      <button type="button" class="plain-button" onClick={onClose}>
        {accessText.close}
      </button>
    </section>
  );
}
