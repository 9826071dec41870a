import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { PlanFrame } from '../../src/practice/plan_frame';
import { Practice } from '../../src/state/practice';
import { PracticeStore } from '../../src/state/practice_store';
import { Store } from '../../src/state/store';
import type { Hello } from '../../src/wire/messages';
import { FakeSurface, FakeView } from '../practice/fake_surface';
import { FakeDeviceSocket, feedback, welcome } from '../wire/fake_device_socket';
import { hello } from '../wire/fake_messages';
import { someSession } from '../wire/some_answers';

function helloOf(sessionId: string): Hello {
  const message = hello({ sessionId });
  if (message.kind !== 'hello') throw new Error('no hello');
  return message.hello;
}

describe('Practice', () => {
  let store: Store;
  let practiceStore: PracticeStore;
  let socket: FakeDeviceSocket;
  let surface: FakeSurface;
  let practice: Practice;
  let attended: boolean;
  let gamepad: Gamepad | null;
  const remembered = new Map<string, string>();

  beforeEach(() => {
    vi.useFakeTimers();
    store = new Store();
    practiceStore = new PracticeStore(store);
    socket = new FakeDeviceSocket();
    surface = new FakeSurface();
    attended = true;
    gamepad = null;
    remembered.clear();
    const view = new FakeView(new PlanFrame(helloOf('s1')));
    const browser = {
      attended: () => attended,
      gamepad: () => gamepad,
      nowMs: () => Date.now(),
      remembered: {
        getItem: (key: string) => remembered.get(key) ?? null,
        setItem: (key: string, value: string) => void remembered.set(key, value),
        removeItem: (key: string) => void remembered.delete(key),
      },
    };
    practice = new Practice(practiceStore, store, socket, surface as never, view, browser, (id) => `ws://${id}`);
    store.sessionId.value = 's1';
    store.sessionState.value = 'running';
    practice.steer('s1');
  });
  afterEach(() => {
    practice.leave();
    vi.useRealTimers();
  });
  const begin = () => {
    store.hello.value = helloOf('s1');
    socket.handlers?.onReport(welcome());
    socket.handlers?.onReport(feedback());
  };

  it('steers once the picture is there, sixty times a second', () => {
    vi.advanceTimersByTime(200);
    expect(socket.opened).toEqual(['ws://s1']);
    expect(socket.inputs).toHaveLength(0);
    begin();
    expect(practiceStore.steering.value).toBe(true);
    surface.fire('pointerdown', { buttons: 1 });
    vi.advanceTimersByTime(1000);
    expect(socket.inputs.length).toBeGreaterThan(55);
    expect(socket.inputs.length).toBeLessThan(70);
    expect(socket.inputs.at(-1)).toMatchObject({ pushN: practiceStore.hand.levelN.value, held: true });
  });

  it('lets go at once when it is told to, and stays so while nobody attends', () => {
    begin();
    surface.fire('pointerdown', { buttons: 1 });
    vi.advanceTimersByTime(1000);
    practice.letGo();
    expect(socket.inputs.at(-1)).toMatchObject({ pushN: 0, spindleOn: false, held: false });
    attended = false;
    surface.fire('pointermove', {});
    vi.advanceTimersByTime(100);
    expect(socket.inputs.at(-1)).toMatchObject({ held: false });
    attended = true;
    surface.fire('pointermove', {});
    vi.advanceTimersByTime(100);
    expect(socket.inputs.at(-1)).toMatchObject({ held: true, pushN: 0 });
  });

  it('pushes no more after the connection was lost, until it is pressed anew', () => {
    begin();
    surface.fire('pointerdown', { buttons: 1 });
    vi.advanceTimersByTime(1000);
    socket.handlers?.onClosed(1006, '');
    expect(practiceStore.hand.pushN.value).toBe(0);
    vi.advanceTimersByTime(300);
    expect(socket.opened).toHaveLength(2);
    begin();
    vi.advanceTimersByTime(500);
    expect(socket.inputs.at(-1)).toMatchObject({ pushN: 0 });
  });

  it('ends with the session, and with another session in the picture', () => {
    begin();
    expect(practice.rememberedId()).toBe('s1');
    store.sessionState.value = 'stopped';
    expect(practiceStore.sessionId.value).toBeNull();
    expect(practice.rememberedId()).toBeNull();
    expect(store.problem.value).toBeNull();

    store.sessionState.value = 'running';
    practice.steer('s1');
    store.sessionId.value = 's2';
    expect(practiceStore.sessionId.value).toBeNull();
    const sent = socket.inputs.length;
    vi.advanceTimersByTime(1000);
    expect(socket.inputs).toHaveLength(sent);
  });

  it('says why when the server sends it away', () => {
    begin();
    socket.handlers?.onClosed(4001, 'another client has become the device of this session');
    expect(practiceStore.sessionId.value).toBeNull();
    expect(store.problem.value).toContain('another client');
  });

  it('takes a gamepad, and lets it tremble with the reamer', () => {
    begin();
    const playEffect = vi.fn(() => Promise.resolve('complete'));
    const buttons = Array.from({ length: 17 }, (_, i) => ({ pressed: i === 7, value: i === 7 ? 1 : 0 }));
    gamepad = { axes: [0, 0, 0, 0], buttons, vibrationActuator: { playEffect } } as unknown as Gamepad;
    vi.advanceTimersByTime(600);
    expect(practiceStore.gamepad.value).toBe(true);
    expect(socket.inputs.at(-1)?.pushN).toBe(practiceStore.hand.levelN.value);
    expect(playEffect).not.toHaveBeenCalled();
    for (let i = 0; i < 30; ++i) socket.handlers?.onReport(feedback({ vibrationG: 0.35 }));
    vi.advanceTimersByTime(400);
    expect(playEffect.mock.calls.length).toBeGreaterThanOrEqual(4);
    gamepad = null;
    vi.advanceTimersByTime(50);
    expect(socket.inputs.at(-1)?.pushN).toBe(0);
  });

  it('starts at the level that is asked for, and at the same place after the page was loaded anew', () => {
    begin();
    expect(practiceStore.level.value).toBe('guided');
    expect(practiceStore.hints.value).toBe(true);
    practice.leave();
    practice.steer('s1', 'own');
    const { place } = practiceStore.hand;
    const started = place.value;
    expect(Math.hypot(started.superior, started.anterior)).toBeGreaterThan(2.9);
    expect(practiceStore.hints.value).toBe(false);
    practice.leave();
    expect(practiceStore.hints.value).toBe(true);
    // Loaded anew, the page knows the session by REST, and the level by itself.
    store.details.value = someSession({ id: 's1' });
    practice.steer('s1');
    expect(practiceStore.level.value).toBe('own');
    expect(place.value).toEqual(started);
    store.sessionId.value = 's2';
    store.details.value = someSession({ id: 's2', reset_of: 's1' });
    practice.steer('s2');
    expect(practiceStore.level.value).toBe('own');
    expect(place.value).not.toEqual(started);
    store.sessionId.value = 's3';
    store.details.value = someSession({ id: 's3', theatre: true });
    practice.steer('s3');
    expect(practiceStore.level.value).toBe('exam');
    store.sessionId.value = 's4';
    store.details.value = someSession({ id: 's4' });
    practice.steer('s4');
    expect(practiceStore.level.value).toBe('guided');
  });
});
