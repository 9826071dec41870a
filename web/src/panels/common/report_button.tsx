import { pageText } from '../../text/page_text';
import { percent } from '../../text/format';
import { ReviewApi } from '../../wire/review_api';
import { Button } from './button';
import { useExport } from './use_export';

const review = new ReviewApi(window.location.origin);

/** Makes the PDF report of a session and gives it to the browser. */
export function ReportButton({ session, onProblem }: { session: string; onProblem: (words: string) => void }) {
  const { share, make } = useExport(review, session, 'pdf', (problem) => {
    if (problem !== null) onProblem(problem);
  });
  return (
    <Button
      testId={`report-${session}`}
      label={share === null ? pageText.reportOf(session) : undefined}
      disabled={share !== null}
      onClick={() => void make()}
    >
      {share === null ? pageText.report : pageText.making(percent(share))}
    </Button>
  );
}
