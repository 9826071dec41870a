import { outcomeText } from '../../text/result_text';
import type { Outcome } from '../../wire/rest_types';

/** In words (`words`: other ones), with a sign that is told apart without colours. */
export function OutcomeMark({ outcome, words }: { outcome: Outcome; words?: string }) {
  return (
    <span class={`outcome outcome-${outcome ?? 'none'}`}>
      <svg viewBox="-8 -8 16 16" width="14" height="14" aria-hidden="true">
        <OutcomeSign outcome={outcome} />
      </svg>
      {words ?? outcomeText[outcome ?? 'none']}
    </span>
  );
}

/** A disc for passed, a cross for failed, a ring for undecided, a dot for what was not judged; about 14 wide. */
export function OutcomeSign({ outcome }: { outcome: Outcome }) {
  switch (outcome) {
    case 'pass':
      return <circle r="6" fill="currentcolor" />;
    case 'fail':
      return <path d="M-5 -5 5 5M5 -5 -5 5" stroke="currentcolor" stroke-width="3" fill="none" />;
    case 'undecided':
      return <circle r="5" stroke="currentcolor" stroke-width="2.5" fill="none" />;
    case null:
      return <circle r="3" fill="currentcolor" />;
  }
}
