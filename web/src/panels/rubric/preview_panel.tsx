import '../../styles/review.css';

import { useSignal } from '@preact/signals';
import { useEffect, useMemo } from 'preact/hooks';

import { addressOfRoute } from '../../state/route';
import type { RubricDraft } from '../../state/rubric/rubric_draft';
import { RubricPreview } from '../../state/rubric/rubric_preview';
import { rubricText } from '../../text/rubric_text';
import { messageOf } from '../../wire/rest';
import type { Session } from '../../wire/rest_types';
import type { RubricApi } from '../../wire/rubric_api';
import { Button } from '../common/button';
import { Message } from '../common/fields';
import { sessionLabel } from '../common/trainee_label';
import { useRemote } from '../common/use_remote';
import { ScoreCard } from '../review/score_panel';

interface Parts {
  api: RubricApi;
  id: string;
  draft: RubricDraft;
}

const offered = 50;

/** What a recorded session is worth by the rubric as it stands. */
export function PreviewPanel({ api, id, draft }: Parts) {
  const preview = useMemo(() => new RubricPreview(api), [api]);
  const sessions = useRemote(() => api.ended(offered));
  useEffect(() => preview.follow(() => draft.rubric.value), [preview, draft]);
  const list = sessions.value.value;
  const score = preview.score.value;
  return (
    <section class="content-panel review-panel rubric-preview" aria-labelledby="preview-title" data-testid="preview">
      <h2 id="preview-title">{rubricText.preview}</h2>
      <p class="soft">{rubricText.previewHint}</p>
      {sessions.problem.value !== null && <Message kind="bad">{sessions.problem.value}</Message>}
      {list?.length === 0 && <p class="soft">{rubricText.noSessions}</p>}
      {list !== null && list.length > 0 && (
        <SessionChoice
          list={list}
          value={preview.session.value}
          onChange={(session) => (preview.session.value = session)}
        />
      )}
      <div role="status">
        {preview.session.value !== '' && draft.rubric.value === null && (
          <Message kind="warn">{rubricText.previewFaults}</Message>
        )}
        {preview.session.value !== '' && draft.rubric.value !== null && score === null && (
          <p class="soft">{rubricText.updating}</p>
        )}
      </div>
      {preview.problem.value !== null && <Message kind="bad">{preview.problem.value}</Message>}
      {score !== null && (
        <div aria-busy={preview.stale.value && draft.rubric.value !== null} data-testid="preview-score">
          <ScoreIt {...{ api, id, session: score.session, unsaved: draft.changed.value }} />
          <ScoreCard score={score} />
        </div>
      )}
    </section>
  );
}

interface ChoiceParts {
  list: readonly Session[];
  value: string;
  onChange: (session: string) => void;
}

function SessionChoice({ list, value, onChange }: ChoiceParts) {
  return (
    <div class="content-form">
      <label>
        {rubricText.session}
        <select data-testid="preview-session" value={value} onChange={(event) => onChange(event.currentTarget.value)}>
          <option value="">{rubricText.chooseSession}</option>
          {list.map((session) => (
            <option key={session.id} value={session.id}>
              {sessionLabel(session)}
            </option>
          ))}
        </select>
      </label>
    </div>
  );
}

/** Scores the session by the rubric as it is saved. */
function ScoreIt({ api, id, session, unsaved }: { api: RubricApi; id: string; session: string; unsaved: boolean }) {
  const done = useSignal<string | null>(null);
  const problem = useSignal<string | null>(null);
  const score = async () => {
    try {
      await api.score(session, id);
      [done.value, problem.value] = [session, null];
    } catch (error) {
      problem.value = messageOf(error);
    }
  };
  return (
    <>
      <p class="score-it">
        <Button
          testId="score-session"
          disabled={unsaved}
          title={unsaved ? rubricText.scoreByHint : undefined}
          onClick={() => void score()}
        >
          {rubricText.scoreBy}
        </Button>
        <a href={addressOfRoute({ kind: 'review', id: session, beside: null })} data-testid="preview-review">
          {rubricText.review}
        </a>
      </p>
      <div role="status">
        {done.value === session && (
          <Message kind="soft" testId="scored">
            {rubricText.scored}
          </Message>
        )}
      </div>
      {problem.value !== null && <Message kind="bad">{problem.value}</Message>}
    </>
  );
}
