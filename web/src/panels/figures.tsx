import type { ComponentChildren } from 'preact';

import type { Store } from '../state/store';
import { words } from '../words';
import { fixed } from './format';

/** One number with its name. */
export function Figure({
  name,
  unit,
  id,
  children,
}: {
  name: string;
  unit?: string;
  id?: string;
  children: ComponentChildren;
}) {
  return (
    <div class="figure">
      <dt>{name}</dt>
      <dd>
        <span data-testid={id}>{children}</span>
        {unit !== undefined && <span class="unit"> {unit}</span>}
      </dd>
    </div>
  );
}

/** The numbers of the moment; a dash where none is known. */
export function Figures({ store }: { store: Store }) {
  const hello = store.hello.value;
  const t = store.reading.value.told;
  const engaged = t !== null && t.densityGCc > 0;
  return (
    <dl class="figures">
      <Figure name={words.removed} unit="mm³" id="removed-volume">
        {fixed(t?.removedVolumeMm3, 0)}
      </Figure>
      <Figure name={words.hand} unit="N" id="hand-force">
        {fixed(t?.handForceN, 2)}
      </Figure>
      <Figure name={words.density} unit="g/cc">
        {engaged ? fixed(t.densityGCc, 2) : words.none}
      </Figure>
      <Figure name={words.cortical} unit="%">
        {engaged ? fixed(t.corticalShare * 100, 0) : words.none}
      </Figure>
      <Figure name={words.spindle}>{t === null ? words.none : t.spindleOn ? words.on : words.off}</Figure>
      <Figure name={words.time} unit="s" id="session-time">
        {fixed(t === null ? null : t.tick / 1000, 1)}
      </Figure>
      <Figure name={words.forceScale} unit=": 1">
        {fixed(hello?.forceScale, 0)}
      </Figure>
      {!store.replaying.value && (
        <>
          <Figure name={words.loop} unit="µs" id="tick-times">
            {fixed(t?.tickMeanUs, 0)} / {fixed(t?.tickP99Us, 0)}
          </Figure>
          <Figure name={words.missed}>{fixed(t?.ticksMissed, 0)}</Figure>
        </>
      )}
      {t !== null && t.dropped > 0 && <Figure name={words.lostSamples}>{fixed(t.dropped, 0)}</Figure>}
    </dl>
  );
}

/** Final figures of a session that has ended. */
export function Results({ store }: { store: Store }) {
  const metrics = store.metrics.value;
  if (metrics === null) return null;
  return (
    <section class="results" aria-labelledby="results-title" data-testid="results">
      <h2 id="results-title">{words.results}</h2>
      <dl class="figures">
        <Figure name={words.meanThrust} unit="N">
          {fixed(metrics.axial_thrust_mean_n, 1)}
        </Figure>
        <Figure name={words.peakThrust} unit="N">
          {fixed(metrics.axial_thrust_peak_n, 1)}
        </Figure>
        <Figure name={words.corticalVolume} unit="mm³">
          {fixed(metrics.removed_volume_cortical_mm3, 0)}
        </Figure>
        <Figure name={words.cancellousVolume} unit="mm³">
          {fixed(metrics.removed_volume_cancellous_mm3, 0)}
        </Figure>
      </dl>
    </section>
  );
}
