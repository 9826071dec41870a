import '../../styles/comment_notices.css';

import type { CommentNotices as Notices } from '../../state/comment_notices';
import { practiceText } from '../../text/practice_text';

interface Parts {
  notices: Notices;
  /** What is pressed next is meant for the reamer again. */
  toPicture: () => void;
}

/** Over the picture, what others say of the work at this moment. */
export function CommentNotices({ notices, toPicture }: Parts) {
  return (
    <div class="comment-notices" role="status" aria-label={practiceText.comments} data-testid="comment-notices">
      {notices.shown.value.map(({ number, comment }) => (
        <div key={number} class="comment-notice" data-testid="comment-notice">
          <p>
            <strong>{comment.author === '' ? practiceText.comment : practiceText.commentBy(comment.author)}</strong>{' '}
            {comment.words}
          </p>
          <button
            type="button"
            aria-label={practiceText.dismissComment}
            title={practiceText.dismissComment}
            onClick={() => {
              notices.dismiss(number);
              toPicture();
            }}
          >
            <span aria-hidden="true">✕</span>
          </button>
        </div>
      ))}
    </div>
  );
}
