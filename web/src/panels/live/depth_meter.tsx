import { reachedWithinMm } from '../../state/alarms';
import type { Store } from '../../state/store';
import { appText } from '../../text/app_text';
import { fixed } from '../../text/format';

/** Reaming depth against the plan. */
export function DepthMeter({ store }: { store: Store }) {
  const plannedMm = store.hello.value?.plannedDepthMm ?? 0;
  const telemetryDepthMm = store.reading.value.telemetry?.depthMm ?? NaN;
  const depthMm = Number.isFinite(telemetryDepthMm) ? telemetryDepthMm : null;
  const share = plannedMm > 0 && depthMm !== null ? Math.min(Math.max(depthMm / plannedMm, 0), 1) : 0;
  const pastMm = depthMm === null ? 0 : depthMm - plannedMm;
  const past = plannedMm > 0 && pastMm > reachedWithinMm;
  return (
    <section class="depth" aria-labelledby="depth-title" title={appText.depthMeaning}>
      <div class="depth-head">
        <h2 id="depth-title">{appText.depth}</h2>
        <p>
          <span class="big" data-testid="depth">
            {fixed(depthMm, 2)}
          </span>{' '}
          mm <span class="soft">{plannedMm > 0 && appText.depthOf(fixed(plannedMm, 2))}</span>
        </p>
      </div>
      <div
        class={past ? 'meter past' : 'meter'}
        role="meter"
        aria-labelledby="depth-title"
        aria-valuemin={0}
        aria-valuemax={plannedMm}
        aria-valuenow={depthMm ?? 0}
        aria-valuetext={depthText(depthMm, plannedMm)}
      >
        <div style={{ width: `${(share * 100).toFixed(1)}%` }} />
      </div>
      <p class="soft depth-text">{depthText(depthMm, plannedMm)}</p>
    </section>
  );
}

function depthText(depthMm: number | null, plannedMm: number): string {
  if (depthMm === null || plannedMm <= 0) return appText.none;
  const leftMm = plannedMm - depthMm;
  if (leftMm > reachedWithinMm) return appText.depthLeft(fixed(leftMm, 2));
  return leftMm < -reachedWithinMm ? appText.depthPast(fixed(-leftMm, 2)) : appText.depthReached;
}
