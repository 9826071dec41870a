import '../styles/review.css';
import '../styles/rating.css';

import { useSignal } from '@preact/signals';
import { useEffect, useMemo, useRef } from 'preact/hooks';

import { Button } from '../panels/common/button';
import { Message } from '../panels/common/fields';
import { PageHeader } from '../panels/common/page_header';
import { ProblemBanner } from '../panels/common/problem_banner';
import { LinkNotice } from '../panels/live/link_notice';
import { PlaybackBar } from '../panels/picture/playback_bar';
import { AnswerForm } from '../panels/study/answer_form';
import { Remote } from '../state/remote';
import { addressOfRoute } from '../state/route';
import { AnswerSheet } from '../state/study/answer_sheet';
import { RatedReplay } from '../state/study/rated_replay';
import { appText } from '../text/app_text';
import { studyText } from '../text/study_text';
import type { QueuedRating, Study } from '../wire/rest_types';
import type { StudyApi } from '../wire/study_api';

interface Parts {
  api: StudyApi;
  studyId: string;
}

/** A rater's replays of a study, one after another, each with its form. */
export function RatingPage({ api, studyId }: Parts) {
  const study = useMemo(() => new Remote(() => api.study(studyId)), [api, studyId]);
  const queue = useMemo(() => new Remote(() => api.ratingQueue(studyId)), [api, studyId]);
  const place = useSignal<number | null>(null);
  useEffect(() => {
    void study.read();
    void queue.read();
  }, [study, queue]);
  const at = place.value ?? firstUnrated(queue.value.value);
  const chosen = queue.value.value?.[at];
  return (
    <div class="page review-page rating-page">
      <PageHeader here="rating" />
      <main class="review-main">
        {chosen !== undefined && <RatedPicture key={chosen.key} {...{ api, studyId, chosen }} />}
      </main>
      <aside class="side review-side" aria-label={studyText.ratingQueue}>
        <RatingPanel
          {...{ api, studyId, study, queue, at, chosen }}
          onChoose={(chosenPlace) => (place.value = chosenPlace)}
        />
      </aside>
    </div>
  );
}

const firstUnrated = (queue: readonly QueuedRating[] | null) =>
  Math.max(queue?.findIndex((one) => one.answers === null) ?? 0, 0);

interface PanelParts extends Parts {
  study: Remote<Study>;
  queue: Remote<QueuedRating[]>;
  at: number;
  chosen: QueuedRating | undefined;
  onChoose: (place: number) => void;
}

/** Which replay it is, and its form. */
function RatingPanel({ api, studyId, study, queue, at, chosen, onChoose }: PanelParts) {
  const list = queue.value.value;
  const loaded = study.value.value;
  const problem = study.problem.value ?? queue.problem.value;
  const keep = (rated: QueuedRating) => {
    onChoose(at);
    queue.value.value = (queue.value.value ?? []).map((one) => (one.key === rated.key ? rated : one));
  };
  return (
    <section class="content-panel questionnaire">
      <p>
        <a href={addressOfRoute({ kind: 'study', id: studyId })} data-testid="back-to-study">
          ‹ {loaded?.name ?? studyText.backToStudy}
        </a>
      </p>
      {problem !== null && <Message kind="bad">{problem}</Message>}
      {list?.length === 0 && <p class="soft">{studyText.nothingToRate}</p>}
      {list !== null && list.length > 0 && <QueueBar {...{ list, at, onChoose }} />}
      {loaded?.state === 'closed' && <Message kind="warn">{studyText.ratingClosed}</Message>}
      {loaded && chosen && <RatingForm key={chosen.key} {...{ api, study: loaded, chosen }} onRated={keep} />}
    </section>
  );
}

interface QueueParts {
  list: readonly QueuedRating[];
  at: number;
  onChoose: (place: number) => void;
}

/** Which replay it is, how many are rated, and the way to another. */
function QueueBar({ list, at, onChoose }: QueueParts) {
  const rated = list.filter((one) => one.answers !== null).length;
  return (
    <div class="content-head content-form">
      <label>
        <span class="visually-hidden">{studyText.ratingQueue}</span>
        <select
          data-testid="rating-choice"
          value={String(at)}
          onChange={(event) => onChoose(Number(event.currentTarget.value))}
        >
          {list.map((one, i) => (
            <option key={one.key} value={String(i)}>
              {studyText.replayNumber(i + 1, list.length)}
              {one.answers === null ? '' : ` (${studyText.ratedMark})`}
            </option>
          ))}
        </select>
      </label>
      <Button testId="next-replay" disabled={at + 1 >= list.length} onClick={() => onChoose(at + 1)}>
        {studyText.nextReplay}
      </Button>
      <p class="soft" role="status" data-testid="rating-progress">
        {studyText.ratingProgress(rated, list.length)}
      </p>
    </div>
  );
}

interface FormParts {
  api: StudyApi;
  study: Study;
  chosen: QueuedRating;
  onRated: (rated: QueuedRating) => void;
}

function RatingForm({ api, study, chosen, onRated }: FormParts) {
  const form = study.rating_form;
  const sheet = useMemo(
    () => form && new AnswerSheet(form, window.sessionStorage, `ream.rating.${study.id}.${chosen.key}`, chosen.answers),
    [form, study.id, chosen.key],
  );
  if (!sheet) return null;
  return (
    <AnswerForm
      sheet={sheet}
      about={studyText.ratingAbout}
      thanks={studyText.ratingSaved}
      sendLabel={studyText.sendRating}
      readOnly={study.state === 'closed'}
      send={async (kept) => onRated(await api.rate(study.id, chosen.key, kept.answers.value))}
    />
  );
}

/** The replay, in a place of the page, as long as it is shown. */
function useReplay(api: StudyApi, studyId: string, key: string) {
  const place = useRef<HTMLDivElement>(null);
  const replay = useMemo(
    () => new RatedReplay(key, () => api.replayForRating(studyId, key), window.location.origin),
    [api, studyId, key],
  );
  useEffect(() => {
    const { canvas } = replay.scene;
    canvas.tabIndex = 0;
    canvas.dataset.testid = 'bone-canvas';
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', appText.sceneLabel);
    place.current?.prepend(canvas);
    replay.start();
    return () => {
      canvas.remove();
      replay.dispose();
    };
  }, [replay]);
  return { place, replay };
}

function RatedPicture({ api, studyId, chosen }: Parts & { chosen: QueuedRating }) {
  const { place, replay } = useReplay(api, studyId, chosen.key);
  const { store, player } = replay;
  const refused = player.refused.value;
  const stale = store.hasPicture.value && !store.upToDate.value;
  const look = stale ? 'picture review-picture stale' : 'picture review-picture';
  return (
    <section class="review-pane" aria-label={studyText.rate} data-testid="rated-replay">
      <div class={look} data-complete={store.pictureComplete.value}>
        <div class="canvas-place" ref={place} />
        {refused === null ? <LinkNotice store={store} mayReam={false} /> : <Refusal words={refused.message} />}
        <ProblemBanner store={store} />
      </div>
      <PlaybackBar store={store} player={player} marks={[]} />
    </section>
  );
}

function Refusal({ words }: { words: string }) {
  return (
    <div class="notice notice-lost" role="alert">
      <p class="notice-title">{studyText.replayRefused}</p>
      <p>{words}</p>
    </div>
  );
}
