import '../../styles/depth_meter.css';

import { reachedWithinMm } from '../../state/alarms';
import type { Store } from '../../state/store';
import { appText } from '../../text/app_text';
import { fixed } from '../../text/format';

/** The plan is at this share of the scale: what lies beyond is seen, too. */
const planShare = 0.8;

/** Reaming depth against the plan, at the edge of the picture: deeper is further down. */
export function DepthMeter({ store }: { store: Store }) {
  const plannedMm = store.hello.value?.plannedDepthMm ?? 0;
  const telemetryDepthMm = store.reading.value.telemetry?.depthMm ?? NaN;
  const depthMm = Number.isFinite(telemetryDepthMm) ? telemetryDepthMm : null;
  const share = plannedMm > 0 && depthMm !== null ? Math.min(Math.max((depthMm / plannedMm) * planShare, 0), 1) : 0;
  const past = plannedMm > 0 && (depthMm ?? 0) - plannedMm > reachedWithinMm;
  const text = depthText(depthMm, plannedMm);
  if (store.hello.value === null) return null;
  return (
    <section class="depth" aria-labelledby="depth-title" title={appText.depthMeaning} data-testid="depth-meter">
      <h2 id="depth-title">{appText.depth}</h2>
      <p>
        <span class="big" data-testid="depth">
          {fixed(depthMm, 2)}
        </span>{' '}
        mm
      </p>
      <div
        class={past ? 'depth-scale past' : 'depth-scale'}
        role="meter"
        aria-labelledby="depth-title"
        aria-valuemin={0}
        aria-valuemax={plannedMm}
        aria-valuenow={Math.min(Math.max(depthMm ?? 0, 0), plannedMm)}
        aria-valuetext={text}
      >
        <div style={{ height: `${(share * 100).toFixed(1)}%` }} />
        {plannedMm > 0 && <span class="depth-plan" style={{ top: `${planShare * 100}%` }} />}
      </div>
      {plannedMm > 0 && <p class="soft depth-of">{appText.depthOf(fixed(plannedMm, 2))}</p>}
      <p class="depth-text">{text}</p>
    </section>
  );
}

function depthText(depthMm: number | null, plannedMm: number): string {
  if (depthMm === null || plannedMm <= 0) return appText.none;
  const leftMm = plannedMm - depthMm;
  if (leftMm > reachedWithinMm) return appText.depthLeft(fixed(leftMm, 2));
  return leftMm < -reachedWithinMm ? appText.depthPast(fixed(-leftMm, 2)) : appText.depthReached;
}
