import { caseWords } from '../../case_words';
import { addressOfRoute } from '../../state/route';
import type { CaseDetails } from '../../wire/case_types';
import { words } from '../../words';

/** Which case this is, and the ways to the other pages. */
export function CaseHeader({ title, details }: { title: string | null; details: CaseDetails | null }) {
  return (
    <header class="header">
      <h1 class="product">{words.product}</h1>
      <nav class="ways">
        <a href={addressOfRoute({ kind: 'live' })} data-testid="to-live">
          {caseWords.live}
        </a>
        <a
          href={addressOfRoute({ kind: 'cases' })}
          data-testid="to-cases"
          aria-current={title === null && details === null ? 'page' : undefined}
        >
          {caseWords.allCases}
        </a>
      </nav>
      {details !== null && (
        <p class="case" data-testid="case-title">
          <strong>{caseWords.sides[details.side]}</strong>
          <span>{details.name || details.id}</span>
        </p>
      )}
      {details?.ct && (
        <p class="soft case-ct">
          {caseWords.radiological} · {caseWords.dims(details.ct.dims)} · {caseWords.spacing(details.ct.spacing_mm)}
        </p>
      )}
    </header>
  );
}
