import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import type { RubricDraft } from '../../state/rubric/rubric_draft';
import { rubricText } from '../../text/rubric_text';
import { Choice } from '../common/form_fields';
import { CriterionCard } from './criterion_card';
import { Fault } from '../common/fault_field';

/** The metrics of a rubric, and the way to another. */
export function CriteriaPanel({ draft }: { draft: RubricDraft }) {
  const { criteria } = draft.content.value;
  const added = useSignal<number | null>(null);
  const none = draft.faults.value.get('criteria');
  // Who adds a line goes on in it.
  useEffect(() => {
    const line = criteria.find(({ key }) => key === added.value);
    if (line !== undefined) document.getElementById(`${line.metric}-weight`)?.focus();
  }, [added.value]);
  return (
    <section class="content-panel" aria-labelledby="criteria-title">
      <h2 id="criteria-title">{rubricText.metrics}</h2>
      {none !== undefined && <Fault id="criteria-fault" words={none} />}
      <ul class="criteria">
        {criteria.map((criterion, place) => (
          <CriterionCard key={criterion.key} {...{ draft, criterion, place, opened: criterion.key === added.value }} />
        ))}
      </ul>
      <AddMetric draft={draft} onAdded={(key) => (added.value = key)} />
    </section>
  );
}

function AddMetric({ draft, onAdded }: { draft: RubricDraft; onAdded: (key: number) => void }) {
  const unused = draft.unused.value;
  if (unused.length === 0) return <p class="soft">{rubricText.noMore}</p>;
  return (
    <div class="content-form">
      <Choice
        {...{ label: rubricText.addMetric, testId: 'add-metric', value: '' }}
        options={[['', rubricText.chooseMetric], ...unused.map(({ metric, name }) => [metric, name] as const)]}
        onChange={(metric) => onAdded(draft.add(metric))}
      />
    </div>
  );
}
