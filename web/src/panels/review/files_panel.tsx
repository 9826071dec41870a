import { useSignal } from '@preact/signals';

import { reviewWords } from '../../review_words';
import type { ReviewSession } from '../../state/review/review_session';
import { wordsOf } from '../../wire/rest';
import { exportFormats, type ExportFormat, type ReviewApi } from '../../wire/review_api';
import { Remark } from '../fields';
import { fixed, sentence } from '../format';
import { later } from '../later';
import { useIdentity } from '../site_nav';

const sharing = later(() => import('../access/share_panel'));

/** Report, files and a link to send. */
export function FilesPanel({ session, review }: { session: ReviewSession; review: ReviewApi }) {
  const identity = useIdentity();
  const may = identity.may.value;
  return (
    <section class="review-panel" aria-label={`${reviewWords.files}, ${session.id}`} data-testid="files">
      <h2>{reviewWords.files}</h2>
      {may.ream ? (
        <ul class="file-list">
          {exportFormats.map((format) => (
            <li key={format}>
              <ExportButton session={session} review={review} format={format} />
            </li>
          ))}
          <li>
            <a
              class="plain-button"
              data-testid="score-file"
              title={reviewWords.scoreFileHint}
              href={review.scoreUrl(session.id)}
              download={`${session.id}-score.json`}
            >
              {reviewWords.scoreFile}
            </a>
          </li>
        </ul>
      ) : (
        <p class="soft">{reviewWords.filesForbidden}</p>
      )}
      <Sharing session={session} mayShare={may.teach && identity.hasUsers.value} open={!identity.hasUsers.value} />
    </section>
  );
}

interface ExportParts {
  session: ReviewSession;
  review: ReviewApi;
  format: ExportFormat;
}

/** Makes a file and gives it to the browser when it is done. */
function ExportButton({ session, review, format }: ExportParts) {
  const share = useSignal<number | null>(null);
  const problem = useSignal<string | null>(null);
  const [label, hint] = reviewWords.formats[format];
  const make = async () => {
    share.value = 0;
    problem.value = null;
    try {
      const url = await review.exported(session.id, format, (now) => (share.value = now));
      const link = document.createElement('a');
      link.href = url;
      link.download = '';
      link.click();
    } catch (error) {
      problem.value = reviewWords.exportFailed(label, sentence(wordsOf(error)));
    } finally {
      share.value = null;
    }
  };
  return (
    <>
      <button
        type="button"
        class="plain-button"
        data-testid={`export-${format}`}
        title={hint}
        disabled={share.value !== null}
        onClick={() => void make()}
      >
        {label}
        {share.value !== null && <span role="status"> {reviewWords.making(fixed(share.value * 100, 0))}</span>}
      </button>
      {problem.value !== null && (
        <Remark kind="bad" testId={`export-problem-${format}`}>
          {problem.value}
        </Remark>
      )}
    </>
  );
}

function Sharing({ session, mayShare, open }: { session: ReviewSession; mayShare: boolean; open: boolean }) {
  const shown = useSignal(false);
  const said = useSignal<string>(reviewWords.copyAddress);
  if (open)
    return (
      <p class="soft share-open">
        {reviewWords.shareOpen}{' '}
        <button
          type="button"
          class="link-button"
          data-testid="copy-address"
          onClick={() =>
            void navigator.clipboard.writeText(window.location.href).then(
              () => (said.value = reviewWords.copied),
              () => (said.value = reviewWords.notCopied),
            )
          }
        >
          {said.value}
        </button>
      </p>
    );
  if (!mayShare) return null;
  if (shown.value)
    return sharing.show(({ SharePanel }) => (
      <SharePanel session={session.id} review onClose={() => (shown.value = false)} />
    ));
  return (
    <button
      type="button"
      class="plain-button"
      data-testid="share-review"
      title={reviewWords.linkHint}
      onClick={() => (shown.value = true)}
    >
      {reviewWords.shareHere}
    </button>
  );
}
