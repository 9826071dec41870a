import { describe, expect, it } from 'vitest';

import { DesignDraft } from '../../../src/state/study/design_draft';

describe('design draft', () => {
  it('asks for nothing until a design is wanted', () => {
    const draft = new DesignDraft();
    expect(draft.design()).toBeNull();
    expect(draft.complete).toBe(true);
  });

  it('names every arm differently, whatever people write', () => {
    const draft = new DesignDraft();
    draft.used.value = true;
    draft.add();
    draft.add();
    draft.change(0, { name: 'Training with sound!' });
    draft.change(1, { name: 'Training with sound!' });
    draft.change(2, { name: '2. Gruppe – Übung' });
    draft.change(3, { name: '手' });
    const ids = draft.design()?.arms.map((arm) => arm.id);
    expect(ids).toEqual(['training_with_sound_1', 'training_with_sound_2', 'gruppe_bung_3', 'arm_4']);
    for (const id of ids ?? []) expect(id).toMatch(/^[a-z][a-z0-9_]{0,63}$/);
  });

  it('is not complete while an arm has no name', () => {
    const draft = new DesignDraft();
    draft.used.value = true;
    draft.change(1, { name: '  ' });
    expect(draft.complete).toBe(false);
    draft.remove(1);
    expect(draft.complete).toBe(true);
    expect(draft.design()).toMatchObject({ pre_sessions: 1, post_sessions: 1, retention_sessions: 0 });
  });
});
