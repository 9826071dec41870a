import { caseText } from '../../text/case_text';
import type { LandmarkEditor } from '../../state/case/landmark_editor';
import type { LandmarkName } from '../../state/case/landmark_names';
import type { Measures, NormalValue } from '../../wire/rest_types';
import { fixed } from '../../text/format';
import { inclinationText, versionText } from './angle_text';
import { Message } from '../common/fields';

/** What the server measures from the saved landmarks, beside what is normal; dimmed while it is of older ones. */
export function MeasuresPanel({ controller }: { controller: LandmarkEditor }) {
  const measures = controller.measures.value;
  const problem = controller.measuresProblem.value;
  const isFresh = controller.measured.value;
  if (measures === null)
    return problem === null ? null : <Message kind="bad">{caseText.measuresFailed(problem)}</Message>;
  return (
    <section class={isFresh ? 'measures' : 'measures stale'} data-testid="measures" data-fresh={isFresh}>
      <h3>
        {caseText.measures}
        {!isFresh && <span class="warn-text"> {problem ?? caseText.measuring}</span>}
      </h3>
      {!isFresh && <p class="warn-text">{caseText.notMeasured}</p>}
      {measures.missing.length > 0 && (
        <p class="soft" data-testid="missing">
          {caseText.missing(measures.missing.map(nameOf).join(', '))}
        </p>
      )}
      <Figures measures={measures} />
    </section>
  );
}

function Figures({ measures }: { measures: Measures }) {
  const { normal } = measures;
  return (
    <dl>
      <Block title={caseText.version} normal={normalText(normal.version_deg, versionText)}>
        <Row name={caseText.method3d} value={versionText(measures.version_3d_deg)} testId="version-3d" />
        <Row
          name={caseText.methodFriedman}
          value={versionText(measures.version_friedman_deg)}
          testId="version-friedman"
        />
      </Block>
      <Block title={caseText.inclination} normal={normalText(normal.inclination_deg, inclinationText)}>
        <Row name={caseText.method3d} value={inclinationText(measures.inclination_3d_deg)} testId="inclination-3d" />
        <Row
          name={caseText.methodTrigonum}
          value={inclinationText(measures.inclination_trigonum_deg)}
          testId="inclination-trigonum"
        />
      </Block>
      <Block title={caseText.subluxation} normal={normalText(normal.subluxation_percent, percentText)}>
        <Row name={caseText.againstScapula} value={percentText(measures.subluxation_percent)} testId="subluxation" />
        <Row
          name={caseText.againstFace}
          value={percentText(measures.subluxation_glenoid_percent)}
          testId="subluxation-glenoid"
        />
      </Block>
      {measures.biconcavity !== null && (
        <Block title={caseText.biconcavity} normal={null}>
          {Object.entries(measures.biconcavity).map(([name, value]) => (
            <Row
              key={name}
              name={caseText.biconcavityFigures[name] ?? name}
              value={biconcavityText(name, value)}
              testId={`biconcavity-${name}`}
            />
          ))}
        </Block>
      )}
    </dl>
  );
}

function Block({
  title,
  normal,
  children,
}: {
  title: string;
  normal: string | null;
  children: preact.ComponentChildren;
}) {
  return (
    <>
      <dt class="measure-title">{title}</dt>
      {children}
      {normal !== null && <dd class="soft normal">{normal}</dd>}
    </>
  );
}

function Row({ name, value, testId }: { name: string; value: string; testId: string }) {
  return (
    <dd class="measure">
      <span class="soft">{name}</span>
      <strong data-testid={testId}>{value}</strong>
    </dd>
  );
}

const percentText = (percent: number | null | undefined): string =>
  percent === null || percent === undefined ? caseText.unknown : caseText.percentValue(fixed(percent, 0));

function normalText(range: NormalValue | undefined, format: (value: number) => string): string | null {
  if (range === undefined) return null;
  const { mean, low, high, source } = range;
  const spread = low === undefined || high === undefined ? null : caseText.normalRange(format(low), format(high));
  return caseText.normal(spread === null ? format(mean) : `${format(mean)}; ${spread}`, source);
}

function nameOf(key: string): string {
  return key === 'biconcavity_mm' ? caseText.biconcavity : (caseText.landmarkNames[key as LandmarkName] ?? key);
}

const biconcavityText = (name: string, degrees: number): string =>
  name === 'between_deg' ? caseText.fixed(fixed(degrees, 1), '°') : versionText(degrees);
