import { caseWords } from '../../case_words';
import type { LandmarkKeeper } from '../../state/case/landmark_keeper';
import type { LandmarkName } from '../../state/case/landmark_names';
import type { Measures, NormalRange } from '../../wire/case_types';
import { fixed } from '../format';
import { inclinationWords, versionWords } from './angle_words';
import { Remark } from '../fields';

/** What the server measures from the saved landmarks, beside what is normal; dimmed while it is of older ones. */
export function MeasuresPanel({ keeper }: { keeper: LandmarkKeeper }) {
  const measures = keeper.measures.value;
  const problem = keeper.measuresProblem.value;
  const isFresh = keeper.measured.value;
  if (measures === null)
    return problem === null ? null : <Remark kind="bad">{caseWords.measuresFailed(problem)}</Remark>;
  return (
    <section class={isFresh ? 'measures' : 'measures stale'} data-testid="measures" data-fresh={isFresh}>
      <h3>
        {caseWords.measures}
        {!isFresh && <span class="warn-text"> {problem ?? caseWords.measuring}</span>}
      </h3>
      {!isFresh && <p class="warn-text">{caseWords.notMeasured}</p>}
      {measures.missing.length > 0 && (
        <p class="soft" data-testid="missing">
          {caseWords.missing(measures.missing.map(nameOf).join(', '))}
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
      <Block title={caseWords.version} normal={normalText(normal.version_deg, versionWords)}>
        <Row name={caseWords.method3d} value={versionWords(measures.version_3d_deg)} testId="version-3d" />
        <Row
          name={caseWords.methodFriedman}
          value={versionWords(measures.version_friedman_deg)}
          testId="version-friedman"
        />
      </Block>
      <Block title={caseWords.inclination} normal={normalText(normal.inclination_deg, inclinationWords)}>
        <Row name={caseWords.method3d} value={inclinationWords(measures.inclination_3d_deg)} testId="inclination-3d" />
        <Row
          name={caseWords.methodFriedman}
          value={inclinationWords(measures.inclination_friedman_deg)}
          testId="inclination-friedman"
        />
      </Block>
      <Block title={caseWords.subluxation} normal={normalText(normal.subluxation_percent, percentWords)}>
        <Row name={caseWords.againstScapula} value={percentWords(measures.subluxation_percent)} testId="subluxation" />
        <Row
          name={caseWords.againstFace}
          value={percentWords(measures.subluxation_glenoid_percent)}
          testId="subluxation-glenoid"
        />
      </Block>
      {measures.biconcavity !== null && (
        <Block title={caseWords.biconcavity} normal={null}>
          {Object.entries(measures.biconcavity).map(([name, value]) => (
            <Row
              key={name}
              name={caseWords.biconcavityFigures[name] ?? name}
              value={biconcavityWords(name, value)}
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

const percentWords = (percent: number | null | undefined): string =>
  percent === null || percent === undefined ? caseWords.unknown : caseWords.percentValue(fixed(percent, 0));

function normalText(range: NormalRange | undefined, inWords: (value: number) => string): string | null {
  if (range === undefined) return null;
  const { mean, low, high, source } = range;
  const spread = low === undefined || high === undefined ? null : caseWords.normalRange(inWords(low), inWords(high));
  return caseWords.normal(spread === null ? inWords(mean) : `${inWords(mean)}; ${spread}`, source);
}

function nameOf(key: string): string {
  return key === 'biconcavity_mm' ? caseWords.biconcavity : (caseWords.landmarkNames[key as LandmarkName] ?? key);
}

const biconcavityWords = (name: string, degrees: number): string =>
  name === 'between_deg' ? caseWords.fixed(fixed(degrees, 1), '°') : versionWords(degrees);
