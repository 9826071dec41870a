import { reviewText } from '../../text/review_text';
import type { ApiError } from '../../wire/rest';

/** Why something is not there, and what can be done. */
export interface SessionError {
  kind: 'gone' | 'live' | 'damaged' | 'forbidden' | 'silent' | 'other';
  title: string;
  text: string;
}

/** In the place of a server's status: a review file that this browser cannot play. */
export const unreadableFile = 415;

/** Words for a session that cannot be shown; the server's own stand behind ours. */
export function sessionErrorOf({ status, message }: Pick<ApiError, 'status' | 'message'>): SessionError {
  const { errors } = reviewText;
  switch (status) {
    case 404:
      return { kind: 'gone', ...errors.gone };
    case 409:
      return { kind: 'live', ...errors.live };
    case 422:
      return { kind: 'damaged', title: errors.damaged.title, text: errors.damaged.text(message) };
    case unreadableFile:
      return { kind: 'damaged', title: errors.fileTitle, text: message };
    case 403:
      return { kind: 'forbidden', ...errors.forbidden };
    case 0:
      return { kind: 'silent', ...errors.silent };
    default:
      return { kind: 'other', title: errors.other.title, text: errors.other.text(message) };
  }
}

/** Words for a map that is not there. */
export function mapErrorMessage({ status, message }: Pick<ApiError, 'status' | 'message'>): string {
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
