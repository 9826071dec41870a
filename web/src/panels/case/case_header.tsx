import { caseText } from '../../text/case_text';
import type { Case } from '../../wire/rest_types';
import { appText } from '../../text/app_text';
import { SiteNav, HeaderEnd } from '../common/site_nav';

/** Which case this is, and the ways to the other pages. */
export function CaseHeader({ details }: { details: Case | null }) {
  return (
    <header class="header">
      <h1 class="product">{appText.product}</h1>
      <SiteNav here={details === null ? 'cases' : 'case'} />
      {details !== null && (
        <p class="case" data-testid="case-title">
          <strong>{caseText.sides[details.side]}</strong>
          <span>{details.name || details.id}</span>
        </p>
      )}
      {details?.ct && (
        <p class="soft case-ct">
          {caseText.radiological} · {caseText.dims(details.ct.dims)} · {caseText.spacing(details.ct.spacing_mm)}
        </p>
      )}
      <HeaderEnd />
    </header>
  );
}
