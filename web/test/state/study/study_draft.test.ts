import { beforeEach, describe, expect, it } from 'vitest';

import { feelComparisons } from '../../../src/state/study/feel_draft';
import { StudyDraft } from '../../../src/state/study/study_draft';

describe('study draft', () => {
  let draft: StudyDraft;
  beforeEach(() => {
    draft = new StudyDraft();
    draft.name.value = ' Who feels cartilage? ';
  });

  it('is of scores at first', () => {
    const study = draft.study();
    expect(study).toEqual({ name: 'Who feels cartilage?', description: '', cases: ['demo'], device: 'browser' });
    draft.rated.value = false;
    expect(draft.study().rating_form).toBeNull();
    draft.toggleCase('demo');
    expect(draft.complete).toBe(false);
  });

  it('of feel has neither cases nor design nor raters, whatever was filled in before', () => {
    draft.design.used.value = true;
    draft.design.change(0, { name: '' });
    draft.toggleCase('demo');
    draft.feel.used.value = true;
    expect(draft.complete).toBe(true);
    expect(draft.study()).toEqual({
      name: 'Who feels cartilage?',
      description: '',
      device: 'browser',
      feel: { comparisons: feelComparisons, trials_per_comparison: 8 },
      rating_form: null,
    });
    draft.questionnaireChoice.value = 'none';
    expect(draft.study().questionnaire).toBeNull();
    draft.questionnaireChoice.value = 'own';
    expect(draft.complete).toBe(false);
  });

  it('of feel counts trials, and asks at least one question, in the usual order', () => {
    const { feel } = draft;
    feel.used.value = true;
    expect(feel.trials).toBe(32);
    feel.toggle('cartilage');
    feel.toggle('density');
    expect(feel.comparisons.value).toEqual(['bone_under_cartilage', 'through_plate']);
    feel.trialsEach.value = 2;
    expect(feel.trials).toBe(4);
    feel.toggle('cartilage');
    expect(draft.study().feel?.comparisons).toEqual(['cartilage', 'bone_under_cartilage', 'through_plate']);
    for (const comparison of feel.comparisons.value) feel.toggle(comparison);
    expect(feel.trials).toBe(0);
    expect(draft.complete).toBe(false);
  });
});
