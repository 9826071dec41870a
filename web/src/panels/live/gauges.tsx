import '../../styles/gauges.css';

import { liveText } from '../../text/live_text';
import { PlanFrame } from '../../practice/plan_frame';
import type { LiveCase } from '../../state/live_case';
import type { Store } from '../../state/store';
import { anglesOfAxis, axisInBone, faceFrame, scapulaPoints } from '../../state/tool_angles';
import { appText } from '../../text/app_text';
import { fixed } from '../../text/format';

/** Off the plan by so much is still good, or still passes: Throckmorton 2015, Hagan 2023; 5 degrees by judgement. */
const goodDeg = 5;
const passesDeg = 10;
/** The scale goes this far to either side of the plan. */
const reachDeg = 15;

/** Where the reamer points, against the plan. */
export function Gauges({ store, liveCase }: { store: Store; liveCase: LiveCase }) {
  const hello = store.hello.value;
  const telemetry = store.atReamer.value;
  if (hello === null) return null;
  const plan = new PlanFrame(hello);
  const frame = faceFrame(plan, scapulaPoints(hello, liveCase.landmarks.value));
  const planned = anglesOfAxis(plan.axis, frame);
  const pose = telemetry?.worldFromTool ?? null;
  const axis = pose === null ? null : axisInBone(pose, telemetry?.worldFromBoneRest ?? null);
  const now = axis === null ? null : anglesOfAxis(axis, frame);
  const named = frame.scapular;
  return (
    <section class="gauges" aria-label={liveText.gauges}>
      <AngleGauge
        id="version"
        name={liveText.version}
        now={now?.versionDeg ?? null}
        planned={planned.versionDeg}
        say={named ? liveText.versionIs : liveText.versionOff}
        ends={[liveText.retro, liveText.ante]}
      />
      <AngleGauge
        id="inclination"
        name={liveText.inclination}
        now={now?.inclinationDeg ?? null}
        planned={planned.inclinationDeg}
        say={named ? liveText.inclinationIs : liveText.inclinationOff}
        ends={[liveText.inferior, liveText.superior]}
      />
      {!named && <p class="soft gauge-note">{liveText.noLandmarks}</p>}
    </section>
  );
}

interface AngleParts {
  id: string;
  name: string;
  now: number | null;
  planned: number;
  say: (text: string, sign: number) => string;
  ends: readonly [string, string];
}

/** The plan is in the middle; marks stand where good ends and where it no longer passes. */
function AngleGauge({ id, name, now, planned, say, ends }: AngleParts) {
  const off = now === null ? null : now - planned;
  const look =
    off === null ? 'unknown' : Math.abs(off) <= goodDeg ? 'good' : Math.abs(off) <= passesDeg ? 'warn' : 'bad';
  const text = spoken(now, say);
  const against = liveText.againstPlan(spoken(planned, say), off === null ? null : fixed(Math.abs(off), 1));
  const place = 50 + (Math.max(-reachDeg, Math.min(reachDeg, off ?? 0)) / reachDeg) * 50;
  return (
    <div class={`gauge gauge-${look}`} data-testid={`gauge-${id}`} data-look={look}>
      <div class="gauge-head">
        <h2 id={`gauge-${id}`}>{name}</h2>
        <p>
          <span class="gauge-now" data-testid={`${id}-now`}>
            {text}
          </span>
        </p>
      </div>
      <div
        class="gauge-scale"
        role="meter"
        aria-labelledby={`gauge-${id}`}
        aria-valuemin={planned - reachDeg}
        aria-valuemax={planned + reachDeg}
        aria-valuenow={now ?? planned}
        aria-valuetext={`${text}; ${against}`}
      >
        <span class="gauge-zone-pass" />
        <span class="gauge-zone-good" />
        <span class="gauge-plan" />
        {off !== null && <span class="gauge-mark" style={{ left: `${place.toFixed(1)}%` }} />}
      </div>
      <p class="soft gauge-text">
        <span>← {ends[0]}</span>
        <span data-testid={`${id}-plan`}>
          {look === 'good' || look === 'unknown' ? '' : look === 'warn' ? '▲ ' : '⬣ '}
          {against}
        </span>
        <span>{ends[1]} →</span>
      </p>
    </div>
  );
}

function spoken(degrees: number | null, say: AngleParts['say']): string {
  if (degrees === null || !Number.isFinite(degrees)) return appText.none;
  const text = fixed(Math.abs(degrees), 1);
  return say(text, text === '0.0' ? 0 : Math.sign(degrees));
}
