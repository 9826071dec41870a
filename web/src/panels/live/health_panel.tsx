import type { ReadonlySignal } from '@preact/signals';

import { type Health, missedHere, pictureDelayMs } from '../../state/health';
import type { Latency } from '../../state/latency';
import type { PracticeStore } from '../../state/practice_store';
import type { Store } from '../../state/store';
import type { Session, Times } from '../../wire/rest_types';
import { appText } from '../../text/app_text';
import { fixed } from '../../text/format';
import { healthText } from '../../text/health_text';
import { liveText } from '../../text/live_text';
import { Figure } from './figures';

interface Parts {
  store: Store;
  practice: PracticeStore;
  latency: Latency;
  health: ReadonlySignal<Health | null>;
}

/** How well simulation, link and picture keep their time: the state that everybody sees, and the figures behind it. */
export function HealthPanel({ store, practice, latency, health }: Parts) {
  const details = store.details.value;
  const session = details !== null && details.id === store.sessionId.value ? details : null;
  const state = health.value?.state ?? null;
  return (
    <details class="sessions health" data-testid="health">
      <summary>
        {appText.health}{' '}
        {state !== null && <span class={state === 'ok' ? 'soft' : 'health-late'}>{healthText.state[state]}</span>}
      </summary>
      <dl class="figures">
        <Picture {...{ store, practice, latency }} />
        <Loop session={session} />
        <Ticks store={store} />
        <Device session={session} practice={practice} />
      </dl>
    </details>
  );
}

function Picture({ store, practice, latency }: Omit<Parts, 'health'>) {
  const steering = practice.steering.value;
  return (
    <>
      <Figure name={`${steering ? liveText.handDelay : liveText.drawDelay} p95`} unit="ms" id="latency">
        {fixed(pictureDelayMs(store, practice, latency), 0)}
      </Figure>
      <Figure name={appText.forceScale} unit=": 1" id="force-scale">
        {fixed(store.hello.value?.forceScale, 0)}
      </Figure>
    </>
  );
}

/** As the stream tells them, tick by tick. */
function Ticks({ store }: { store: Store }) {
  const t = store.reading.value.telemetry;
  return (
    <>
      <Figure name={appText.loop} unit="µs" id="tick-times">
        {fixed(t?.tickMeanUs, 0)} / {fixed(t?.tickP99Us, 0)}
      </Figure>
      <Figure name={appText.missed}>{fixed(t?.ticksMissed, 0)}</Figure>
      <Figure name={appText.missedShare} unit="%" id="missed-share">
        {fixed(missedHere(store), 2)}
      </Figure>
      {t !== null && t.dropped > 0 && <Figure name={appText.lostSamples}>{fixed(t.dropped, 0)}</Figure>}
    </>
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
