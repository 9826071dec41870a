import { caseWords } from '../../case_words';
import type { CaseDetails } from '../../wire/case_types';
import { words } from '../../words';
import { SiteNav, WhoAmI } from '../site_nav';

/** Which case this is, and the ways to the other pages. */
export function CaseHeader({ details }: { details: CaseDetails | null }) {
  return (
    <header class="header">
      <h1 class="product">{words.product}</h1>
      <SiteNav here={details === null ? 'cases' : 'case'} />
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
      <WhoAmI />
    </header>
  );
}
