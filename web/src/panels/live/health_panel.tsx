import type { PracticeStore } from '../../state/practice_store';
import type { Store } from '../../state/store';
import type { Session, Times } from '../../wire/rest_types';
import { appText } from '../../text/app_text';
import { Figure } from './figures';
import { fixed } from '../../text/format';

/** A share of missed ticks above this is worth saying, percent. */
export const lateAbovePercent = 0.1;

/** Of the ticks of the watched session, or null while that is not known. */
export function missedPercent(store: Store): number | null {
  const details = store.details.value;
  const session = details !== null && details.id === store.sessionId.value ? details : null;
  const telemetry = store.reading.value.telemetry;
  const missed = telemetry?.ticksMissed ?? session?.loop.missed ?? null;
  const ticks = telemetry?.tick ?? session?.tick ?? 0;
  return missed === null || ticks === 0 ? null : (missed / ticks) * 100;
}

/** How well the haptic loop keeps its time and its device: one word, and the figures behind it. */
export function HealthPanel({ store, practice }: { store: Store; practice: PracticeStore }) {
  const details = store.details.value;
  const session = details !== null && details.id === store.sessionId.value ? details : null;
  const percent = missedPercent(store);
  const late = percent !== null && percent > lateAbovePercent;
  const word =
    percent === null ? appText.healthUnknown : late ? appText.healthLate(fixed(percent, 1)) : appText.healthOnTime;
  return (
    <details class="sessions health" data-testid="health">
      <summary>
        {appText.health} <span class={late ? 'health-late' : 'soft'}>{word}</span>
      </summary>
      <dl class="figures">
        <Loop session={session} />
        <Figure name={appText.missedShare} unit="%" id="missed-share">
          {fixed(percent, 2)}
        </Figure>
        <Device session={session} practice={practice} />
      </dl>
    </details>
  );
}

function Loop({ session }: { session: Session | null }) {
  const loop = session?.loop;
  return (
    <>
      <Pair name={appText.tickTimes} id="tick-p99" a={loop?.p50_us} b={loop?.p99_us} />
      <Pair name={appText.tickTail} a={loop?.p999_us} b={loop?.max_us} />
      {loop !== undefined && <Lateness timing={loop.lateness} />}
      {loop !== undefined && (
        <Figure name={appText.realtime} id="realtime">
          {loop.realtime ? appText.granted : appText.notGranted}
        </Figure>
      )}
    </>
  );
}

function Lateness({ timing }: { timing: Times }) {
  return (
    <>
      <Pair name={appText.lateness} a={timing.p50_us} b={timing.p99_us} />
      <Pair name={appText.latenessTail} a={timing.p999_us} b={timing.max_us} />
    </>
  );
}

function Device({ session, practice }: { session: Session | null; practice: PracticeStore }) {
  const device = session?.device;
  if (device === undefined) return null;
  const rttMs = practice.feedback.value?.rttMs ?? device.rtt_ms;
  return (
    <>
      <Figure name={appText.device} id="device-state">
        {appText.deviceName(device.name)}
        {device.state !== null && `, ${appText.deviceState(device.state)}`}
      </Figure>
      {rttMs !== null && (
        <Figure name={appText.deviceRtt} unit="ms" id="device-rtt">
          {fixed(rttMs, 1)}
        </Figure>
      )}
    </>
  );
}

function Pair({ name, id, a, b }: { name: string; id?: string; a: number | undefined; b: number | undefined }) {
  return (
    <Figure name={name} unit="µs" id={id}>
      {fixed(a, 0)} / {fixed(b, 0)}
    </Figure>
  );
}
