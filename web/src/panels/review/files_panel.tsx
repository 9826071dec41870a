import { useSignal } from '@preact/signals';

import { reviewText } from '../../text/review_text';
import type { ReviewSession } from '../../state/review/review_session';
import { exportFormats, type ExportFormat, type ReviewApi } from '../../wire/review_api';
import { Message } from '../common/fields';
import { useExport } from '../common/use_export';
import { percent, sentence } from '../../text/format';
import { lazyPart } from '../common/lazy_part';
import { useIdentity } from '../common/site_nav';
import { Button } from '../common/button';

const sharing = lazyPart(() => import('../access/share_panel'));

/** Report, files and a link to send. */
export function FilesPanel({ session, review }: { session: ReviewSession; review: ReviewApi }) {
  const identity = useIdentity();
  const may = identity.may.value;
  // Of what is not there, or not theirs to see, there are no files.
  const absent = ['gone', 'forbidden'].includes(session.error.value?.kind ?? '');
  return (
    <section class="review-panel" aria-label={`${reviewText.files}, ${session.id}`} data-testid="files">
      <h2>{reviewText.files}</h2>
      {may.ream ? (
        <ul class="file-list">
          {exportFormats.map((format) => (
            <li key={format}>
              <ExportButton session={session} review={review} format={format} absent={absent} />
            </li>
          ))}
          <li>
            <a
              class={absent ? 'plain-button disabled' : 'plain-button'}
              aria-disabled={absent}
              data-testid="score-file"
              title={reviewText.scoreFileHint}
              href={absent ? undefined : review.scoreUrl(session.id)}
              download={`${session.id}-score.json`}
            >
              {reviewText.scoreFile}
            </a>
          </li>
        </ul>
      ) : (
        <p class="soft">{reviewText.filesForbidden}</p>
      )}
      {!absent && (
        <Sharing session={session} mayShare={may.teach && identity.hasUsers.value} open={!identity.hasUsers.value} />
      )}
    </section>
  );
}

interface ExportParts {
  session: ReviewSession;
  review: ReviewApi;
  format: ExportFormat;
  absent: boolean;
}

/** Makes a file and gives it to the browser when it is done. */
function ExportButton({ session, review, format, absent }: ExportParts) {
  const problem = useSignal<string | null>(null);
  const [label, hint] = reviewText.formats[format];
  const { share, make } = useExport(review, session.id, format, (reason) => {
    problem.value = reason === null ? null : reviewText.exportFailed(label, sentence(reason));
  });
  return (
    <>
      <Button testId={`export-${format}`} title={hint} disabled={absent || share !== null} onClick={() => void make()}>
        {label}
        {share !== null && <span role="status"> {reviewText.making(percent(share))}</span>}
      </Button>
      {problem.value !== null && (
        <Message kind="bad" testId={`export-problem-${format}`}>
          {problem.value}
        </Message>
      )}
    </>
  );
}

function Sharing({ session, mayShare, open }: { session: ReviewSession; mayShare: boolean; open: boolean }) {
  const shown = useSignal(false);
  const buttonText = useSignal<string>(reviewText.copyAddress);
  if (open)
    return (
      <p class="soft share-open">
        {reviewText.shareOpen}{' '}
        <button
          type="button"
          class="link-button"
          data-testid="copy-address"
          onClick={() =>
            void navigator.clipboard.writeText(window.location.href).then(
              () => (buttonText.value = reviewText.copied),
              () => (buttonText.value = reviewText.notCopied),
            )
          }
        >
          {buttonText.value}
        </button>
      </p>
    );
  if (!mayShare) return null;
  if (shown.value)
    return sharing.show(({ SharePanel }) => (
      <SharePanel session={session.id} review onClose={() => (shown.value = false)} />
    ));
  return (
    <Button testId="share-review" title={reviewText.linkHint} onClick={() => (shown.value = true)}>
      {reviewText.shareHere}
    </Button>
  );
}
