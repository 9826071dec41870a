import type { CriterionDraft } from '../../state/rubric/criterion_draft';
import type { KnownMetric } from '../../wire/rest_types';

/** What the fields of one line need. */
export interface LineParts {
  criterion: CriterionDraft;
  known: KnownMetric | null;
  fault: (field: string) => string | undefined;
  idOf: (field: string) => string;
  change: (changes: Partial<CriterionDraft>) => void;
}
