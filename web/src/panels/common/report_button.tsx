import { useSignal } from '@preact/signals';

import { pageText } from '../../text/page_text';
import { percent } from '../../text/format';
import { messageOf } from '../../wire/rest';
import { ReviewApi } from '../../wire/review_api';
import { Button } from './button';

const review = new ReviewApi(window.location.origin);

/** Makes the PDF report of a session and gives it to the browser. */
export function ReportButton({ session, onProblem }: { session: string; onProblem: (words: string) => void }) {
  const share = useSignal<number | null>(null);
  const make = async () => {
    share.value = 0;
    try {
      const link = document.createElement('a');
      link.href = await review.exported(session, 'pdf', (now) => (share.value = now));
      link.download = '';
      link.click();
    } catch (error) {
      onProblem(messageOf(error));
    } finally {
      share.value = null;
    }
  };
  return (
    <Button
      testId={`report-${session}`}
      label={share.value === null ? pageText.reportOf(session) : undefined}
      disabled={share.value !== null}
      onClick={() => void make()}
    >
      {share.value === null ? pageText.report : pageText.making(percent(share.value))}
    </Button>
  );
}
