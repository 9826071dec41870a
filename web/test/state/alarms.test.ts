import { describe, expect, it } from 'vitest';

import { Alarms, pastPlanMm, ThrustWatch } from '../../src/state/alarms';
import { Store } from '../../src/state/store';
import type { Hello, Telemetry } from '../../src/wire/messages';
import { hello, telemetry } from '../wire/fake_messages';
import { someMetrics } from '../wire/some_answers';

const batch = (tick: number, thrust: number[], changes: Partial<Telemetry> = {}): Telemetry => {
  const message = telemetry({
    tick,
    firstTick: tick - thrust.length + 1,
    thrustN: Float32Array.from(thrust),
    ...changes,
  });
  if (message.kind !== 'telemetry') throw new Error('no telemetry');
  return message.telemetry;
};

function liveStore(changes: Partial<Hello> = {}): Store {
  const store = new Store();
  const message = hello(changes);
  if (message.kind === 'hello') store.hello.value = message.hello;
  store.link.value = { kind: 'live' };
  store.pictureComplete.value = true;
  store.sessionState.value = 'running';
  return store;
}

describe('the alarm of excess thrust', () => {
  it('tells the greatest of the last moments, and ends', () => {
    const watch = new ThrustWatch();
    expect(watch.take(batch(100, [60, 78]))).toBeNull();
    expect(watch.take(batch(130, [60, 90, 70]))).toBe(90);
    expect(watch.take(batch(160, [85, 60]))).toBe(90);
    expect(watch.take(batch(1629, [50]))).toBe(90);
    expect(watch.take(batch(1631, [50]))).toBe(85);
    expect(watch.take(batch(1661, [50]))).toBeNull();
  });

  it('leaves history aside and forgets what lies ahead after a step back', () => {
    const watch = new ThrustWatch();
    expect(watch.take(batch(9000, [200, 10], { firstTick: 5000, tickStride: 4000 }))).toBeNull();
    expect(watch.take(batch(9100, [99]))).toBe(99);
    expect(watch.take(batch(40, [10]))).toBeNull();
  });
});

describe('alarms', () => {
  it('say how far past the plan, where there is one', () => {
    expect(pastPlanMm(2.04, 2)).toBeNull();
    expect(pastPlanMm(2.5, 2)).toBeCloseTo(0.5, 9);
    expect(pastPlanMm(2.5, 0)).toBeNull();
    expect(pastPlanMm(NaN, 2)).toBeNull();
  });

  it('grow from a warning to a bad one', () => {
    const store = liveStore();
    const alarms = new Alarms(store);
    store.telemetry.value = batch(100, [90], { depthMm: 2.4, densityGCc: 1 });
    expect(alarms.now.value.map(({ kind, level }) => `${kind} ${level}`)).toEqual(['thrust warn', 'depth warn']);
    store.telemetry.value = batch(130, [110], { depthMm: 3.4, densityGCc: 1 });
    expect(alarms.now.value.map(({ kind, level }) => `${kind} ${level}`)).toEqual(['thrust bad', 'depth bad']);
  });

  it('of depth ends once the reamer is withdrawn, though the bone stays gone, and begins again at a touch', () => {
    const store = liveStore();
    const alarms = new Alarms(store);
    const at = (tick: number, densityGCc: number) => {
      store.telemetry.value = batch(tick, [10 * densityGCc], { depthMm: 2.4, densityGCc });
      return alarms.now.value.map(({ kind }) => kind);
    };
    expect(at(100, 1)).toEqual(['depth']);
    // The reamer bounces on the bone while it cuts.
    expect(at(300, 0)).toEqual(['depth']);
    expect(at(400, 1)).toEqual(['depth']);
    expect(at(901, 0)).toEqual([]);
    expect(at(5000, 0)).toEqual([]);
    expect(at(5030, 0.2)).toEqual(['depth']);
    // A step back in a recording, to before anything was touched.
    expect(at(50, 0)).toEqual([]);
  });

  it('of depth is told by the thrust alone where the density is hidden, and ends without it', () => {
    const store = liveStore();
    const alarms = new Alarms(store);
    const at = (tick: number, thrust: number) => {
      store.telemetry.value = batch(tick, [thrust], { depthMm: 2.4, densityGCc: 0 });
      return alarms.now.value.map(({ kind }) => kind);
    };
    expect(at(100, 30)).toEqual(['depth']);
    expect(at(300, 0)).toEqual(['depth']);
    expect(at(601, 0)).toEqual([]);
  });

  it('of depth, thrust and heat are not told of a session that has ended with the reamer on the bone', () => {
    const store = liveStore();
    const alarms = new Alarms(store);
    store.telemetry.value = batch(100, [90], { depthMm: 2.4, densityGCc: 1, surfaceTemperatureC: 60 });
    expect(alarms.now.value.map(({ kind }) => kind)).toEqual(['thrust', 'depth', 'heat']);
    for (const state of ['stopped', 'finished', 'fault', 'interrupted'] as const) {
      store.sessionState.value = state;
      expect(alarms.now.value, state).toEqual([]);
    }
  });

  it('are not told of what is not of this moment, nor of the session before', () => {
    const store = liveStore();
    const alarms = new Alarms(store);
    store.telemetry.value = batch(100, [90], { depthMm: 2.4, densityGCc: 1 });
    store.link.value = { kind: 'silent', sinceMs: 0 };
    expect(alarms.now.value).toEqual([]);
    store.link.value = { kind: 'live' };
    expect(alarms.now.value).toHaveLength(2);
    const next = hello({ sessionId: 'b' });
    store.telemetry.value = null;
    if (next.kind === 'hello') store.hello.value = next.hello;
    store.telemetry.value = batch(120, [20]);
    expect(alarms.now.value).toEqual([]);
  });

  it('tell of bone that is too warm while somebody reams, and nothing where heat is not simulated', () => {
    const store = liveStore();
    const alarms = new Alarms(store);
    const at = (surfaceTemperatureC: number | null) => {
      store.telemetry.value = batch(100, [10], { surfaceTemperatureC });
      return alarms.now.value;
    };
    expect(at(null)).toEqual([]);
    expect(at(46.9)).toEqual([]);
    expect(at(47)).toEqual([{ kind: 'heat', level: 'warn', value: 47 }]);
    expect(at(56)).toEqual([{ kind: 'heat', level: 'bad', value: 56 }]);
    store.sessionState.value = 'finished';
    expect(alarms.now.value).toEqual([]);
  });

  it('say nothing of a breached vault: the score says it, once there is nothing left to stop', () => {
    const store = liveStore();
    const alarms = new Alarms(store);
    store.telemetry.value = batch(100, [0], { depthMm: 9, densityGCc: 0 });
    store.sessionState.value = 'stopped';
    store.metrics.value = someMetrics({ vault_breach_mm: 0.8 });
    expect(alarms.now.value).toEqual([]);
  });
});
