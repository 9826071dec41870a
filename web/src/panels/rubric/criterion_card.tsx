import { useSignal } from '@preact/signals';

import type { CriterionDraft, LimitsChoice, PointsChoice } from '../../state/rubric/criterion_draft';
import { twoPoints, type RubricDraft } from '../../state/rubric/rubric_draft';
import { bandText, unitOf, withUnit } from '../../state/review/score_text';
import { rubricText } from '../../text/rubric_text';
import { sentence } from '../../text/format';
import type { KnownMetric } from '../../wire/rest_types';
import { Button } from '../common/button';
import { CurveFields } from './curve_fields';
import { Fault, FaultField, NumberLine } from '../common/fault_field';
import type { LineParts } from './line_parts';

interface Parts {
  draft: RubricDraft;
  criterion: CriterionDraft;
  /** Of its line, from 0. */
  place: number;
  /** Opened when it is drawn first: a new line. */
  opened: boolean;
}

/** One metric of a rubric: its weight at a glance, points and limits below. */
export function CriterionCard({ draft, criterion, place, opened }: Parts) {
  const { metric, key } = criterion;
  const known = draft.metrics.find((one) => one.metric === metric) ?? null;
  const name = known?.name ?? metric;
  const faults = draft.faults.value;
  const line: LineParts = {
    criterion,
    known,
    fault: (field) => faults.get(`criteria/${place}/${field}`),
    idOf: (field) => `${metric}-${field.replace(/\//g, '-')}`,
    change: (changes) => draft.change(key, changes),
  };
  const metricFault = line.fault('metric');
  return (
    <li class="criterion" data-testid={`criterion-${metric}`}>
      <fieldset>
        <legend title={known?.definition}>{name}</legend>
        <div class="criterion-line">
          <NumberLine
            {...{ label: rubricText.weight, id: line.idOf('weight'), fault: line.fault('weight') }}
            value={criterion.weight}
            onInput={(weight) => line.change({ weight })}
          />
          <CriticalField line={line} />
          <Button testId={`remove-${metric}`} label={rubricText.removeOf(name)} onClick={() => draft.remove(key)}>
            {rubricText.remove}
          </Button>
        </div>
        {metricFault !== undefined && <Fault id={line.idOf('metric-fault')} words={metricFault} />}
        <Details line={line} opened={opened} bad={[...faults.keys()].some((at) => isDetail(at, place))} />
      </fieldset>
    </li>
  );
}

const isDetail = (at: string, place: number) =>
  at.startsWith(`criteria/${place}/`) && !/\/(weight|critical|metric)$/.test(at);

function CriticalField({ line: { criterion, fault, idOf, change } }: { line: LineParts }) {
  const bad = fault('critical');
  return (
    <span class="fault-field">
      <label class="check">
        <input
          type="checkbox"
          data-testid={idOf('critical')}
          aria-invalid={bad !== undefined}
          aria-describedby={bad === undefined ? undefined : idOf('critical-fault')}
          checked={criterion.critical}
          onChange={(event) => change({ critical: event.currentTarget.checked })}
        />
        {rubricText.critical}
      </label>
      {bad !== undefined && <Fault id={idOf('critical-fault')} words={bad} />}
    </span>
  );
}

/** Stays open while something in it is wrong. */
function Details({ line, opened, bad }: { line: LineParts; opened: boolean; bad: boolean }) {
  const open = useSignal(opened);
  return (
    <details
      open={open.value || bad}
      onToggle={(event) => (open.value = event.currentTarget.open)}
      data-testid={line.idOf('details')}
    >
      <summary>
        {rubricText.details} <span class="soft">{inShort(line)}</span>
      </summary>
      <div class="criterion-line">
        <PointsField line={line} />
        <LimitsFields line={line} />
      </div>
      {line.criterion.points === 'curve' && <CurveFields line={line} />}
      <SourceField line={line} />
    </details>
  );
}

function SourceField({ line }: { line: LineParts }) {
  return (
    <label class="criterion-source">
      {rubricText.source}
      <input
        type="text"
        maxLength={1000}
        value={line.criterion.source}
        onInput={(event) => line.change({ source: event.currentTarget.value })}
      />
    </label>
  );
}

/** "0 mm → 100, 4 mm → 0": what a closed line says of its points. */
function inShort({ criterion, known }: LineParts): string {
  if (criterion.points === 'limits') return rubricText.pointsFromNames.limits;
  return criterion.curve.map(({ at, points }) => `${withUnit(at, known?.unit ?? null)} → ${points}`).join(', ');
}

function PointsField({ line: { criterion, fault, idOf, change } }: { line: LineParts }) {
  return (
    <FaultField {...{ label: rubricText.pointsFrom, id: idOf('points'), fault: fault('points') }}>
      {(described) => (
        <select
          {...described}
          data-testid={idOf('points')}
          value={criterion.points}
          onChange={(event) => {
            const points = event.currentTarget.value as PointsChoice;
            const curve = points === 'limits' ? [] : criterion.curve.length > 0 ? criterion.curve : twoPoints;
            change({ points, curve });
          }}
        >
          {Object.entries(rubricText.pointsFromNames).map(([value, words]) => (
            <option key={value} value={value}>
              {words}
            </option>
          ))}
        </select>
      )}
    </FaultField>
  );
}

function LimitsFields({ line }: { line: LineParts }) {
  const { criterion, known, fault, idOf, change } = line;
  const { limits } = criterion;
  return (
    <>
      <FaultField {...{ label: rubricText.limits, id: idOf('limits'), fault: fault('band') }}>
        {(described) => (
          <select
            {...described}
            data-testid={idOf('limits')}
            value={limits}
            onChange={(event) => change({ limits: event.currentTarget.value as LimitsChoice })}
          >
            {Object.entries(rubricText.limitsNames).map(([value, words]) => (
              <option key={value} value={value}>
                {words}
              </option>
            ))}
          </select>
        )}
      </FaultField>
      {limits === 'catalogue' && known !== null && (
        <span class="soft criterion-usual">{sentence(bandText(known.band, known.unit))}</span>
      )}
      {numbersOf(limits).map(([field, label]) => (
        <NumberLine
          key={field}
          {...{ label: labelWithUnit(label, known), id: idOf(field), fault: fault(`band/${field}`) }}
          value={criterion[field]}
          onInput={(value) => change({ [field]: value })}
        />
      ))}
    </>
  );
}

/** The numbers that limits of a kind have, in reading order. */
function numbersOf(limits: LimitsChoice): (readonly ['pass' | 'warn' | 'low', string])[] {
  switch (limits) {
    case 'catalogue':
      return [];
    case 'less':
      return [
        ['pass', rubricText.pass],
        ['warn', rubricText.warn],
      ];
    case 'more':
      return [
        ['pass', rubricText.passFrom],
        ['warn', rubricText.warnFrom],
      ];
    case 'between':
      return [
        ['low', rubricText.low],
        ['pass', rubricText.passRange],
      ];
  }
}

function labelWithUnit(label: string, known: KnownMetric | null): string {
  const unit = unitOf(known?.unit ?? null);
  return unit === '' ? label : `${label} (${unit})`;
}
