import { useSignal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';

import { Remote } from '../../state/remote';
import { studyText } from '../../text/study_text';
import { CaseApi } from '../../wire/case_api';
import { messageOf } from '../../wire/rest';
import type { StudyApi } from '../../wire/study_api';
import type { NewStudy } from '../../wire/rest_types';
import { Remark } from '../common/fields';

/** The form for another study. */
export function MakeStudy({ api, onMade }: { api: StudyApi; onMade: (studyId: string) => void }) {
  const cases = useMemo(() => new Remote(() => new CaseApi(window.location.origin).cases()), []);
  useEffect(() => void cases.read(), [cases]);
  const wanted = useSignal({ name: '', description: '', cases: ['demo'], device: 'browser', asking: 'ours' });
  const file = useSignal<Record<string, unknown> | null>(null);
  const problem = useSignal<string | null>(null);
  const set = (change: Partial<typeof wanted.value>) => (wanted.value = { ...wanted.value, ...change });
  const usable = cases.value.value?.filter((one) => one.stage === 'built' && one.planned) ?? [];
  const toggle = (id: string) => {
    const chosen = wanted.value.cases;
    set({ cases: chosen.includes(id) ? chosen.filter((one) => one !== id) : [...chosen, id] });
  };
  const readFile = async (picked: File | undefined) => {
    file.value = null;
    problem.value = null;
    if (picked === undefined) return;
    try {
      file.value = JSON.parse(await picked.text()) as Record<string, unknown>;
    } catch {
      problem.value = studyText.fileUnreadable;
    }
  };
  const make = async (event: Event) => {
    event.preventDefault();
    const { name, description, device, asking } = wanted.value;
    const study: NewStudy = { name: name.trim(), description: description.trim(), cases: wanted.value.cases };
    if (device !== '') study.device = device;
    if (asking === 'none') study.questionnaire = null;
    if (asking === 'file') study.questionnaire = file.value;
    problem.value = null;
    try {
      onMade((await api.make(study)).id);
    } catch (error) {
      problem.value = messageOf(error);
    }
  };
  const { name, description, device, asking } = wanted.value;
  const complete = wanted.value.cases.length > 0 && (asking !== 'file' || file.value !== null);
  return (
    <section class="desk-panel" aria-labelledby="make-title">
      <h2 id="make-title">{studyText.make}</h2>
      <form class="desk-form" onSubmit={(event) => void make(event)}>
        <label>
          {studyText.name}
          <input
            type="text"
            required
            maxLength={200}
            data-testid="study-name"
            value={name}
            onInput={(event) => set({ name: event.currentTarget.value })}
          />
        </label>
        <label>
          {studyText.device}
          <select
            data-testid="study-device"
            value={device}
            onChange={(event) => set({ device: event.currentTarget.value })}
          >
            {studyText.devices.map(([value, text]) => (
              <option key={value} value={value}>
                {text}
              </option>
            ))}
          </select>
        </label>
        <label>
          {studyText.questionnaire}
          <select
            data-testid="study-questionnaire"
            value={asking}
            onChange={(event) => set({ asking: event.currentTarget.value })}
          >
            <option value="ours">{studyText.ownQuestionnaire}</option>
            <option value="none">{studyText.noQuestionnaire}</option>
            <option value="file">{studyText.fileQuestionnaire}</option>
          </select>
        </label>
        {asking === 'file' && (
          <label>
            {studyText.questionnaireFile}
            <input
              type="file"
              accept=".json,application/json"
              data-testid="questionnaire-file"
              onChange={(event) => void readFile(event.currentTarget.files?.[0])}
            />
          </label>
        )}
        <label class="wide">
          {studyText.description}
          <textarea
            rows={2}
            maxLength={4000}
            data-testid="study-description"
            value={description}
            onInput={(event) => set({ description: event.currentTarget.value })}
          />
        </label>
        <fieldset class="wide">
          <legend>{studyText.cases}</legend>
          {cases.value.value !== null && usable.length === 0 && <span class="soft">{studyText.noCases}</span>}
          {usable.map((one) => (
            <label class="check" key={one.id}>
              <input
                type="checkbox"
                data-testid={`study-case-${one.id}`}
                checked={wanted.value.cases.includes(one.id)}
                onChange={() => toggle(one.id)}
              />
              {one.name || one.id}
            </label>
          ))}
        </fieldset>
        <button type="submit" class="main-button" data-testid="make-study" disabled={!complete}>
          {studyText.makeButton}
        </button>
      </form>
      {problem.value !== null && (
        <Remark kind="bad" testId="make-problem">
          {problem.value}
        </Remark>
      )}
    </section>
  );
}
