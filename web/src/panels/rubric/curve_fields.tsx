import { type CurveDraft, maxCurvePoints } from '../../state/rubric/criterion_draft';
import { unitOf } from '../../state/review/score_text';
import { rubricText } from '../../text/rubric_text';
import { Button } from '../common/button';
import { Fault, NumberLine } from '../common/fault_field';
import type { LineParts } from './line_parts';

/** The curve of a metric, point by point. */
export function CurveFields({ line }: { line: LineParts }) {
  const { criterion, known, fault, idOf, change } = line;
  const { curve } = criterion;
  const unit = unitOf(known?.unit ?? null);
  const set = (place: number, changes: Partial<CurveDraft>) =>
    change({ curve: curve.map((point, i) => (i === place ? { ...point, ...changes } : point)) });
  const bad = fault('curve');
  return (
    <div class="curve" role="group" aria-label={rubricText.curve}>
      <p class="soft">{rubricText.curveHint}</p>
      {curve.map((point, i) => (
        <div class="criterion-line" key={i} role="group" aria-label={rubricText.curvePoint(i + 1)}>
          <NumberLine
            label={unit === '' ? rubricText.value : rubricText.valueIn(unit)}
            {...{ id: idOf(`at-${i}`), fault: fault(`curve/${i}/at`), value: point.at }}
            onInput={(at) => set(i, { at })}
          />
          <NumberLine
            label={rubricText.points}
            {...{ id: idOf(`worth-${i}`), fault: fault(`curve/${i}/points`), value: point.points }}
            onInput={(points) => set(i, { points })}
          />
          {curve.length > 2 && (
            <Button
              label={rubricText.removePoint(i + 1)}
              onClick={() => change({ curve: curve.filter((_, at) => at !== i) })}
            >
              {rubricText.remove}
            </Button>
          )}
        </div>
      ))}
      {bad !== undefined && <Fault id={idOf('curve-fault')} words={bad} />}
      {curve.length < maxCurvePoints && (
        <Button testId={idOf('add-point')} onClick={() => change({ curve: [...curve, { at: '', points: '0' }] })}>
          {rubricText.addPoint}
        </Button>
      )}
    </div>
  );
}
