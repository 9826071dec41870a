import { readFileSync } from 'node:fs';

import { describe, expect, it } from 'vitest';

import { RubricDraft, rubricId } from '../../../src/state/rubric/rubric_draft';
import { rubricText } from '../../../src/text/rubric_text';
import type { KnownMetric, Rubric } from '../../../src/wire/rest_types';

const proto = (path: string) =>
  JSON.parse(readFileSync(new URL(`../../../../${path}`, import.meta.url), 'utf8')) as unknown;

const known = (metric: string, band: KnownMetric['band'] = { better: 'report only' }): KnownMetric => ({
  ...{ metric, name: metric, unit: 'mm', definition: '', source: '', band },
});
const metrics = [known('depth_error_mm', { better: 'less', pass: 0.5, warn: 1 }), known('duration_s'), known('passes')];

const depthOnly: Rubric = { name: 'Ours', version: 3, criteria: [{ metric: 'depth_error_mm' }] };
const draftOf = (rubric: Rubric, of = metrics) =>
  new RubricDraft({ id: 'ours', version: rubric.version, versions: [rubric.version], rubric }, of);
const faultsAt = (draft: RubricDraft) => [...draft.faults.value.keys()];

describe('a rubric while it is edited', () => {
  it.each(['proto/rubrics/standard.json', 'examples/rubric.json'])('says of %s what that says', (path) => {
    const rubric = proto(path) as Rubric;
    const all = rubric.criteria.map(({ metric }) => known(metric, { better: 'less', pass: 1, warn: 2 }));
    const draft = draftOf(rubric, all);
    expect(draft.changed.value).toBe(false);
    expect(faultsAt(draft)).toEqual([]);
    expect(draft.rubric.value).toEqual({ least_said_percent: 50, ...rubric });
  });

  it('makes a line from none to full a curve', () => {
    const draft = draftOf({ ...depthOnly, criteria: [{ metric: 'depth_error_mm', none: 2, full: 0 }] });
    expect(draft.rubric.value?.criteria[0]?.curve).toEqual([
      { at: 0, points: 100 },
      { at: 2, points: 0 },
    ]);
  });

  it('knows what was changed, and forgets it when it is saved', () => {
    const draft = draftOf(depthOnly);
    const [line] = draft.content.value.criteria;
    draft.change(line?.key ?? -1, { weight: '2' });
    expect(draft.changed.value).toBe(true);
    draft.change(line?.key ?? -1, { weight: '1' });
    expect(draft.changed.value).toBe(false);
    draft.set({ passPoints: '70' });
    const rubric = draft.rubric.value as Rubric;
    draft.take({ id: 'ours', version: 4, versions: [3, 4], rubric });
    expect(draft.changed.value).toBe(false);
    expect(draft.rubric.value).toMatchObject({ version: 4, pass_points: 70 });
    const sent = draft.content.value;
    draft.set({ passPoints: '75' });
    draft.take({ id: 'ours', version: 5, versions: [4, 5], rubric }, sent);
    expect(draft.changed.value).toBe(true);
    expect(draft.rubric.value).toMatchObject({ version: 5, pass_points: 75 });
  });

  it('offers each metric once', () => {
    const draft = draftOf(depthOnly);
    draft.add('passes');
    expect(draft.unused.value.map(({ metric }) => metric)).toEqual(['duration_s']);
  });

  it('says beside each field what the server would refuse', () => {
    const draft = draftOf(depthOnly);
    draft.set({ name: ' ', passPoints: '101', leastMeasured: '' });
    expect(faultsAt(draft)).toEqual(['name', 'pass_points', 'least_said_percent']);
    expect(draft.rubric.value).toBeNull();
    draft.set({ name: 'Ours', passPoints: '', leastMeasured: '50' });
    const key = draft.add('duration_s');
    expect(faultsAt(draft)).toEqual(['criteria/1/curve/0/at', 'criteria/1/curve/1/at']);
    draft.change(key, {
      curve: [
        { at: '1e999', points: '0' },
        { at: '', points: '100' },
      ],
    });
    expect(faultsAt(draft)).toEqual(['criteria/1/curve/0/at', 'criteria/1/curve/1/at']);
    draft.change(key, { points: 'limits', curve: [], critical: true });
    expect(faultsAt(draft)).toEqual(['criteria/1/critical', 'criteria/1/points']);
    draft.change(key, { limits: 'less', pass: '60', warn: '30' });
    expect(draft.faults.value.get('criteria/1/band/warn')).toBe(rubricText.limitsOrder.less);
    draft.change(key, { limits: 'between', low: '30' });
    expect(draft.rubric.value?.criteria[1]).toMatchObject({ band: { better: 'between', low: 30, pass: 60 } });
    draft.remove(key);
    draft.remove(draft.content.value.criteria[0]?.key ?? -1);
    expect(faultsAt(draft)).toEqual(['criteria']);
  });

  it('says it of what the server did refuse, until the next change', () => {
    const draft = draftOf(depthOnly);
    draft.refuse([{ pointer: '#/criteria/0/metric', detail: 'is no metric' }]);
    expect(draft.faults.value.get('criteria/0/metric')).toBe('is no metric');
    draft.set({ remark: 'x' });
    expect(faultsAt(draft)).toEqual([]);
  });
});

describe('the id of a new rubric', () => {
  it('is its name in plain letters, with a number where that is taken', () => {
    expect(rubricId('House rubric (2nd)', [])).toBe('house-rubric-2nd');
    expect(rubricId('Standard', ['standard', 'standard-2'])).toBe('standard-3');
    expect(rubricId('評価', [])).toBe('rubric');
    expect(rubricId('a'.repeat(200), [])).toMatch(/^[a-z0-9-]{1,64}$/);
  });
});
