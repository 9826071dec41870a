import { useSignal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';

import { sessionText } from '../../text/session_text';
import { Remote } from '../../state/remote';
import { everything, type SessionBrowser } from '../../state/sessions/session_browser';
import { CaseApi } from '../../wire/case_api';
import type { SessionState } from '../../wire/messages';
import { StudyApi } from '../../wire/study_api';

/** A search is made when the typing rests for so long. */
const typingRestsMs = 300;

const stateChoices: readonly (readonly [string, string, readonly SessionState[]])[] = [
  ['any', sessionText.anyState, []],
  ['live', sessionText.underWay, ['created', 'running', 'paused']],
  ['ended', sessionText.ended, ['finished', 'stopped']],
  ['fault', sessionText.withFault, ['fault', 'interrupted']],
];

/** Which sessions are listed. */
export function FilterBar({ browser }: { browser: SessionBrowser }) {
  const query = browser.query.value;
  const cases = useMemo(() => new Remote(() => new CaseApi(window.location.origin).cases()), []);
  const studies = useMemo(() => new Remote(() => new StudyApi(window.location.origin).studies()), []);
  useEffect(() => {
    void cases.read();
    void studies.read();
  }, [cases, studies]);
  const text = useSignal(query.text);
  useEffect(() => {
    if (text.value === browser.query.peek().text) return;
    const timer = setTimeout(() => void browser.show({ text: text.value }), typingRestsMs);
    return () => clearTimeout(timer);
  }, [text.value]);
  const state = stateChoices.find(([, , states]) => states.join() === query.states.join())?.[0] ?? 'any';
  return (
    <form class="desk-form filters" role="search" onSubmit={(event) => event.preventDefault()}>
      <label>
        {sessionText.search}
        <input
          type="search"
          maxLength={200}
          placeholder={sessionText.searchHint}
          data-testid="search"
          value={text.value}
          onInput={(event) => (text.value = event.currentTarget.value)}
        />
      </label>
      <label>
        {sessionText.state}
        <select
          data-testid="filter-state"
          value={state}
          onChange={(event) => {
            const chosen = stateChoices.find(([key]) => key === event.currentTarget.value);
            void browser.show({ states: chosen?.[2] ?? [] });
          }}
        >
          {stateChoices.map(([key, label]) => (
            <option key={key} value={key}>
              {label}
            </option>
          ))}
        </select>
      </label>
      <Choice
        label={sessionText.case}
        testId="filter-case"
        value={query.caseId}
        options={(cases.value.value ?? []).map((one) => [one.id, one.name || one.id])}
        onChange={(caseId) => void browser.show({ caseId })}
      />
      {(studies.value.value?.length ?? 0) > 0 && (
        <Choice
          label={sessionText.study}
          testId="filter-study"
          value={query.study}
          options={(studies.value.value ?? []).map((one) => [one.id, one.name])}
          onChange={(study) => void browser.show({ study })}
        />
      )}
      {(['from', 'to'] as const).map((key) => (
        <label key={key}>
          {sessionText[key]}
          <input
            type="date"
            data-testid={`filter-${key}`}
            value={query[key]}
            onChange={(event) => void browser.show({ [key]: event.currentTarget.value })}
          />
        </label>
      ))}
      {browser.filtered.value && (
        <button
          type="button"
          class="plain-button"
          data-testid="clear-filters"
          onClick={() => {
            text.value = '';
            const { sort, descending } = browser.query.peek();
            void browser.show({ ...everything, sort, descending });
          }}
        >
          {sessionText.clear}
        </button>
      )}
    </form>
  );
}

interface ChoiceParts {
  label: string;
  testId: string;
  value: string;
  options: readonly (readonly [string, string])[];
  onChange: (value: string) => void;
}

function Choice({ label, testId, value, options, onChange }: ChoiceParts) {
  return (
    <label>
      {label}
      <select data-testid={testId} value={value} onChange={(event) => onChange(event.currentTarget.value)}>
        <option value="">{sessionText.any}</option>
        {options.map(([id, name]) => (
          <option key={id} value={id}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}
