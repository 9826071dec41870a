import { dashboardText } from '../../text/dashboard_text';
import { type CurvePoint, curveOfLearning, curveOfSessions, scaleFor } from '../../state/dashboard/curve';
import type { Dashboard } from '../../state/dashboard/dashboard';
import type { Learning } from '../../wire/rest_types';
import { dayAndTime, fixed } from '../../text/format';
import { Message } from '../common/fields';
import { CurveChart } from './curve_chart';
import { OutcomeMark } from './outcome_mark';

interface Parts {
  dashboard: Dashboard;
  /** The user's own, and nobody else's. */
  own: boolean;
  hasUsers: boolean;
}

/** How somebody comes on, session after session. */
export function LearningPanel({ dashboard, own, hasUsers }: Parts) {
  const { learners, learner, learning, ended } = dashboard;
  const curves = learning.value.value;
  const somebody = own || learner.value !== null;
  const sessions = ended.value.value;
  const alone = sessions !== null && !somebody;
  return (
    <section class="content-panel learning" aria-labelledby="learning-title">
      <div class="content-head">
        <h2 id="learning-title">{dashboardText.learning}</h2>
        {learners.value.length > 0 && (
          <label class="learner-choice content-count">
            <span class="soft">{dashboardText.ofWhom}</span>
            <select
              data-testid="learner"
              value={learner.value?.key}
              onChange={(event) => dashboard.choose(event.currentTarget.value)}
            >
              {learners.value.map((one) => (
                <option key={one.key} value={one.key}>
                  {dashboardText.learnerSessions(one.name, one.sessions)}
                </option>
              ))}
            </select>
          </label>
        )}
      </div>
      {somebody && learning.problem.value !== null && (
        <Message kind="bad" testId="learning-problem">
          {learning.problem.value}
        </Message>
      )}
      {somebody && curves !== null && <Course learning={curves} own={own} />}
      {alone && <Alone points={curveOfSessions(sessions)} hasUsers={hasUsers} />}
    </section>
  );
}

function Course({ learning, own }: { learning: Learning; own: boolean }) {
  const points = curveOfLearning(learning);
  if (points.length === 0)
    return (
      <p class="soft" data-testid="no-course">
        {own ? dashboardText.noOwnSessions : dashboardText.noneRecent}
      </p>
    );
  const sums = points.flatMap(({ cusum }) => (cusum === null ? [] : [cusum]));
  const { proficient_at: proficient, not_proficient_at: not } = learning;
  return (
    <>
      <p data-testid="standing" data-standing={learning.standing}>
        <strong>{dashboardText.standing[learning.standing]}</strong>{' '}
        {learning.standing !== 'proficient' && dashboardText.passesToGo(learning.passes_to_go)}
      </p>
      <PointsChart points={points} />
      <CurveChart
        title={dashboardText.cusumOver}
        points={points}
        value={(point) => point.cusum}
        scale={scaleFor(sums, [proficient, not, 0])}
        lines={[
          { at: not, name: dashboardText.notProficientLine },
          { at: 0, name: null },
          { at: proficient, name: dashboardText.proficientLine },
        ]}
        decimals={1}
      />
      <p class="soft">
        {dashboardText.standingWhy(percent(learning.acceptable_rate), percent(learning.unacceptable_rate))}{' '}
        {dashboardText.byRubric(learning.rubric.id, learning.rubric.version)}
      </p>
      <Table points={points} />
    </>
  );
}

/** Where nobody is known by name or code. */
function Alone({ points, hasUsers }: { points: readonly CurvePoint[]; hasUsers: boolean }) {
  return (
    <>
      <p class="soft" data-testid="no-learner">
        {hasUsers || points.length === 0 ? dashboardText.noLearner : dashboardText.allTogether}
      </p>
      {!hasUsers && points.length > 0 && (
        <>
          <PointsChart points={points} />
          <Table points={points} />
        </>
      )}
    </>
  );
}

function PointsChart({ points }: { points: readonly CurvePoint[] }) {
  return (
    <CurveChart
      title={dashboardText.pointsOver}
      points={points}
      value={(point) => point.points}
      scale={{ low: -4, high: 104 }}
      lines={[0, 50, 100].map((at) => ({ at, name: null }))}
      decimals={1}
    />
  );
}

function Table({ points }: { points: readonly CurvePoint[] }) {
  const sums = points.some(({ cusum }) => cusum !== null);
  return (
    <details class="curve-table">
      <summary>{dashboardText.asTable}</summary>
      <table class="data-table" data-testid="curve-table">
        <thead>
          <tr>
            <th scope="col" class="number">
              {dashboardText.sessionNumber}
            </th>
            <th scope="col">{dashboardText.when}</th>
            <th scope="col" class="number">
              {dashboardText.points}
            </th>
            <th scope="col">{dashboardText.result}</th>
            {sums && (
              <th scope="col" class="number">
                {dashboardText.cusum}
              </th>
            )}
          </tr>
        </thead>
        <tbody>
          {points.map((point, i) => (
            <tr key={point.session}>
              <td class="number">{i + 1}</td>
              <td class="when">{dayAndTime(point.created_utc)}</td>
              <td class="number">{fixed(point.points, 1)}</td>
              <td>
                <OutcomeMark outcome={point.outcome} />
              </td>
              {sums && <td class="number">{fixed(point.cusum, 2)}</td>}
            </tr>
          ))}
        </tbody>
      </table>
    </details>
  );
}

const percent = (share: number) => fixed(share * 100, 0);
