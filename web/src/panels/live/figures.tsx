import type { ComponentChildren } from 'preact';

import { heatLevel } from '../../state/alarms';
import type { Store } from '../../state/store';
import { appText } from '../../text/app_text';
import { fixed } from '../../text/format';
import { standingSpindleRadS, type Telemetry } from '../../wire/telemetry';

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
  const t = store.reading.value.telemetry;
  const now = store.atReamer.value;
  const engaged = now !== null && now.densityGCc > 0;
  return (
    <dl class="figures">
      <Figure name={appText.removed} unit="mm³" id="removed-volume">
        {fixed(t?.removedVolumeMm3, 0)}
      </Figure>
      <Figure name={appText.hand} unit="N" id="hand-force">
        {fixed(now?.handForceN, 2)}
      </Figure>
      <Figure name={appText.density} unit="g/cc">
        {engaged ? fixed(now.densityGCc, 2) : appText.none}
      </Figure>
      <Figure name={appText.cortical} unit="%">
        {engaged ? fixed(now.corticalShare * 100, 0) : appText.none}
      </Figure>
      <Spindle telemetry={now} />
      <SurfaceTemperature celsius={now?.surfaceTemperatureC ?? null} />
      <Figure name={appText.time} unit="s" id="session-time">
        {fixed(t === null ? null : t.tick / 1000, 1)}
      </Figure>
    </dl>
  );
}

/** Its speed, or why it has none. */
function Spindle({ telemetry: t }: { telemetry: Telemetry | null }) {
  // Recordings from before the drive had a speed do not tell it.
  if (t === null || t.stalled || !t.spindleOn || t.spindleSpeedRadS === 0) {
    const state = t === null ? appText.none : t.stalled ? appText.stalled : t.spindleOn ? appText.on : appText.off;
    return (
      <Figure name={appText.spindle} id="spindle-speed">
        {state}
      </Figure>
    );
  }
  return (
    <Figure
      name={appText.spindle}
      unit={t.spindleSpeedRadS < -standingSpindleRadS ? appText.rpmReversed : appText.rpm}
      id="spindle-speed"
    >
      {fixed((Math.abs(t.spindleSpeedRadS) * 30) / Math.PI, 0)}
    </Figure>
  );
}

/** Of the bone under the reamer; what is too warm is said in words, too. */
function SurfaceTemperature({ celsius }: { celsius: number | null }) {
  const level = heatLevel(celsius);
  return (
    <Figure name={appText.surfaceTemperature} unit="°C" id="surface-temperature">
      {level !== null && (
        <span class={`figure-alarm alarm-text-${level}`}>
          {level === 'bad' ? appText.surfaceHot : appText.surfaceWarm}{' '}
        </span>
      )}
      {fixed(celsius, 0)}
    </Figure>
  );
}
