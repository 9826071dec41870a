import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { healthHere, type Health } from '../../src/state/health';
import { Latency } from '../../src/state/latency';
import { PracticeStore } from '../../src/state/practice_store';
import { Store } from '../../src/state/store';
import { healthText } from '../../src/text/health_text';
import type { Telemetry } from '../../src/wire/messages';
import { telemetry } from '../wire/fake_messages';

function place() {
  const store = new Store();
  const practice = new PracticeStore(store);
  const latency = new Latency();
  const health = healthHere(store, practice, latency);
  store.link.value = { kind: 'live' };
  store.pictureComplete.value = true;
  store.sessionState.value = 'running';
  const tell = (changes: Partial<Telemetry>) => {
    const message = telemetry(changes);
    if (message.kind === 'telemetry') store.telemetry.value = message.telemetry;
    // Numbers are read a few times a second.
    vi.advanceTimersByTime(500);
  };
  return { store, latency, health, tell };
}
const said = (health: Health | null) => (health === null ? null : `${health.state} ${health.cause ?? ''}`.trim());

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

describe('the simulator’s health', () => {
  it('is one of three states, each with words, and advice where something is wrong', () => {
    const { store, health } = place();
    expect(said(health.value)).toBe('ok');
    store.link.value = { kind: 'silent', sinceMs: 0 };
    expect(said(health.value)).toBe('lost stream');
    store.link.value = { kind: 'lost', sinceMs: 0, retryAtMs: null, reason: '' };
    expect(health.value).toBeNull();
    store.hasPicture.value = true;
    expect(said(health.value)).toBe('lost stream');
    store.link.value = { kind: 'refused', serverRevision: 1 };
    expect(said(health.value)).toBe('lost version');
    store.link.value = { kind: 'nothing' };
    expect(health.value).toBeNull();
    for (const words of [...Object.values(healthText.state), ...Object.values(healthText.advice)])
      expect(words).not.toMatch(/\btick|p95|\bloop|\bms\b/i);
  });

  it('is slow by the server only while a session is under way', () => {
    const { store, health, tell } = place();
    tell({ tick: 10_000, ticksMissed: 10 });
    expect(said(health.value)).toBe('ok');
    tell({ tick: 10_000, ticksMissed: 11 });
    expect(said(health.value)).toBe('slow server');
    store.sessionState.value = 'stopped';
    expect(said(health.value)).toBe('ok');
  });

  it('is slow by the picture from a limit on, and rests near it', () => {
    const { latency, health, store } = place();
    const at = (ms: number) => {
      latency.drawingMs.value = ms;
      return said(health.value);
    };
    expect([at(99), at(101), at(90), at(79), at(90)]).toEqual(['ok', 'slow picture', 'slow picture', 'ok', 'ok']);
    expect(at(101)).toBe('slow picture');
    store.sessionState.value = 'finished';
    expect(said(health.value)).toBe('ok');
    store.behindMs.value = 2000;
    expect(said(health.value)).toBe('slow network');
  });
});
