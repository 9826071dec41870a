import { liveText } from '../../text/live_text';
import { type Alarm, type Alarms, excessThrustN, extremeThrustN, hotC, warmC } from '../../state/alarms';
import { fixed } from '../../text/format';

/** Over the picture: what should not be. Announced once when it begins; its figure is only to be seen. */
export function AlarmList({ alarms }: { alarms: Alarms }) {
  return (
    <div class="alarms" aria-label={liveText.alarms} role="status" data-testid="alarms">
      {alarms.now.value.map((alarm) => (
        <div key={alarm.kind} class={`alarm alarm-${alarm.level}`} data-testid={`alarm-${alarm.kind}`}>
          <svg viewBox="0 0 24 24" aria-hidden="true">
            {alarm.level === 'bad' ? (
              <path d="M7.5 1.5h9l6 6v9l-6 6h-9l-6-6v-9zM11 6v8h2V6zm0 10v2.4h2V16z" fill-rule="evenodd" />
            ) : (
              <path d="M12 1.8 23 21.5H1zM11 8.5v6.5h2V8.5zm0 8.2v2.3h2v-2.3z" fill-rule="evenodd" />
            )}
          </svg>
          <span>
            <strong>{title(alarm)}</strong>
            <span class="alarm-figure" aria-hidden="true">
              {' '}
              {fixed(alarm.value, units[alarm.kind].digits)} {units[alarm.kind].unit}
            </span>
            <span class="alarm-why">{why(alarm)}</span>
          </span>
        </div>
      ))}
    </div>
  );
}

const units: Record<Alarm['kind'], { unit: string; digits: number }> = {
  thrust: { unit: 'N', digits: 0 },
  depth: { unit: 'mm', digits: 1 },
  heat: { unit: '°C', digits: 0 },
};

function title({ kind, level }: Alarm): string {
  if (kind === 'thrust') return level === 'bad' ? liveText.thrustExtreme : liveText.thrustExcess;
  if (kind === 'heat') return level === 'bad' ? liveText.surfaceHot : liveText.surfaceWarm;
  return liveText.depthPast;
}

function why({ kind, level }: Alarm): string {
  if (kind === 'thrust')
    return level === 'bad'
      ? liveText.thrustExtremeWhy(fixed(extremeThrustN, 0))
      : liveText.thrustExcessWhy(fixed(excessThrustN, 0));
  if (kind === 'heat')
    return level === 'bad' ? liveText.surfaceHotWhy(fixed(hotC, 0)) : liveText.surfaceWarmWhy(fixed(warmC, 0));
  return liveText.depthPastWhy;
}
