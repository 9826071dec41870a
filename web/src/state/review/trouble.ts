import { reviewText } from '../../text/review_text';
import type { ApiError } from '../../wire/rest';

/** Why something is not there, and what can be done. */
export interface Trouble {
  kind: 'gone' | 'live' | 'damaged' | 'forbidden' | 'silent' | 'other';
  title: string;
  text: string;
}

/** Words for a session that cannot be shown; the server's own stand behind ours. */
export function troubleWithSession({ status, message }: Pick<ApiError, 'status' | 'message'>): Trouble {
  const { trouble } = reviewText;
  switch (status) {
    case 404:
      return { kind: 'gone', ...trouble.gone };
    case 409:
      return { kind: 'live', ...trouble.live };
    case 422:
      return { kind: 'damaged', title: trouble.damaged.title, text: trouble.damaged.text(message) };
    case 403:
      return { kind: 'forbidden', ...trouble.forbidden };
    case 0:
      return { kind: 'silent', ...trouble.silent };
    default:
      return { kind: 'other', title: trouble.other.title, text: trouble.other.text(message) };
  }
}

/** Words for a map that is not there. */
export function troubleWithMap({ status, message }: Pick<ApiError, 'status' | 'message'>): string {
  const { noMap } = reviewText;
  switch (status) {
    case 0:
      return noMap.silent;
    case 403:
      return noMap.forbidden;
    case 404:
      return noMap.nothing(message);
    case 422:
      return noMap.damaged(message);
    default:
      return noMap.other(message);
  }
}
