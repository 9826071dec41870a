import { type Signal, useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { sessionText } from '../../text/session_text';
import { everything, type SessionBrowser } from '../../state/sessions/session_browser';
import { CaseApi } from '../../wire/case_api';
import type { SessionState } from '../../wire/messages';
import { StudyApi } from '../../wire/study_api';
import { Choice, TextLine } from '../common/form_fields';
import { useRemote } from '../common/use_remote';
import { Button } from '../common/button';

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
  const text = useSearchText(browser);
  const clear = () => {
    text.value = '';
    const { sort, descending } = browser.query.peek();
    void browser.show({ ...everything, sort, descending });
  };
  return (
    <form class="content-form filters" role="search" onSubmit={(event) => event.preventDefault()}>
      <TextLine
        {...{ label: sessionText.search, placeholder: sessionText.searchHint, testId: 'search', value: text.value }}
        {...{ type: 'search', maxLength: 200 }}
        onInput={(typed) => (text.value = typed)}
      />
      <StateChoice browser={browser} />
      <CaseAndStudy browser={browser} />
      <Days browser={browser} />
      {browser.filtered.value && (
        <Button testId="clear-filters" onClick={clear}>
          {sessionText.clear}
        </Button>
      )}
    </form>
  );
}

/** What is typed to be sought; it is sought once the typing rests. */
function useSearchText(browser: SessionBrowser): Signal<string> {
  const text = useSignal(browser.query.value.text);
  useEffect(() => {
    if (text.value === browser.query.peek().text) return;
    const timer = setTimeout(() => void browser.show({ text: text.value }), typingRestsMs);
    return () => clearTimeout(timer);
  }, [text.value]);
  return text;
}

function StateChoice({ browser }: { browser: SessionBrowser }) {
  const wanted = browser.query.value.states.join();
  const show = (chosen: string) => {
    const choice = stateChoices.find(([key]) => key === chosen);
    void browser.show({ states: choice?.[2] ?? [] });
  };
  return (
    <Choice
      label={sessionText.state}
      testId="filter-state"
      value={stateChoices.find(([, , states]) => states.join() === wanted)?.[0] ?? 'any'}
      options={stateChoices.map(([key, label]) => [key, label])}
      onChange={show}
    />
  );
}

function CaseAndStudy({ browser }: { browser: SessionBrowser }) {
  const query = browser.query.value;
  const cases = useRemote(() => new CaseApi(window.location.origin).cases());
  const studies = useRemote(() => new StudyApi(window.location.origin).studies());
  const any = ['', sessionText.any] as const;
  return (
    <>
      <Choice
        {...{ label: sessionText.case, testId: 'filter-case', value: query.caseId }}
        options={[any, ...(cases.value.value ?? []).map((one) => [one.id, one.name || one.id] as const)]}
        onChange={(caseId) => void browser.show({ caseId })}
      />
      {(studies.value.value?.length ?? 0) > 0 && (
        <Choice
          {...{ label: sessionText.study, testId: 'filter-study', value: query.study }}
          options={[any, ...(studies.value.value ?? []).map((one) => [one.id, one.name] as const)]}
          onChange={(study) => void browser.show({ study })}
        />
      )}
    </>
  );
}

function Days({ browser }: { browser: SessionBrowser }) {
  return (
    <>
      {(['from', 'to'] as const).map((key) => (
        <label key={key}>
          {sessionText[key]}
          <input
            type="date"
            data-testid={`filter-${key}`}
            value={browser.query.value[key]}
            onChange={(event) => void browser.show({ [key]: event.currentTarget.value })}
          />
        </label>
      ))}
    </>
  );
}
