import { batch } from '@preact/signals';
import { Vector3 } from 'three';
import { beforeEach, describe, expect, it } from 'vitest';

import { PracticeStore } from '../../src/state/practice_store';
import { Store } from '../../src/state/store';
import { stepNames } from '../../src/state/tutorial';
import { Tutorial } from '../../src/state/tutorial_guide';
import type { Session } from '../../src/wire/rest_types';
import type { Telemetry } from '../../src/wire/messages';
import { hello, telemetry } from '../wire/fake_messages';

describe('Tutorial', () => {
  let store: Store;
  let practiceStore: PracticeStore;
  let tutorial: Tutorial;
  let eye: { towardsEye: Vector3; distanceMm: number };
  let made: string[];
  let resets: number;
  let stops: number;
  let practised: string[];
  let resetState: 'running' | 'created';
  let shown: string;
  const kept = new Map<string, string>();
  const storage = {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => void kept.set(key, value),
  };

  /** What the watcher does when a session is made. */
  const make = (id: string, resetOf: string | null = null, state: 'running' | 'created' = 'running') => {
    batch(() => {
      store.sessionId.value = id;
      store.sessionState.value = state;
      store.details.value = { id, reset_of: resetOf, theatre: false } as Session;
      store.pictureComplete.value = false;
    });
    return Promise.resolve(id);
  };
  const end = (state: 'stopped' | 'fault') => {
    store.sessionState.value = state;
    practiceStore.sessionId.value = null;
  };
  const picture = (id: string) => {
    const message = hello({ sessionId: id });
    if (message.kind === 'hello') store.hello.value = message.hello;
    store.telemetry.value = null;
    store.link.value = { kind: 'live' };
    store.pictureComplete.value = true;
  };
  const tell = (changes: Partial<Telemetry>) => {
    const message = telemetry({ tick: ++tick, ...changes });
    if (message.kind === 'telemetry') store.telemetry.value = message.telemetry;
  };
  let tick = 0;

  beforeEach(() => {
    kept.clear();
    made = [];
    resets = stops = 0;
    practised = ['a', 'd'];
    resetState = 'running';
    shown = '';
    store = new Store();
    practiceStore = new PracticeStore(store);
    eye = { towardsEye: new Vector3(1, 0, 0), distanceMm: 100 };
    tutorial = new Tutorial({
      ...{ store, practiceStore },
      practice: {
        steer: (id) => {
          made.push(id);
          practiceStore.sessionId.value = id;
        },
      },
      watcher: {
        practise: (caseId) => {
          expect(caseId).toBe('demo');
          return make(practised.shift() ?? '');
        },
        reset: () => {
          ++resets;
          return make('b', 'a', resetState);
        },
        stop: () => {
          ++stops;
          return Promise.resolve();
        },
      },
      view: { eye: () => eye, begin: () => (shown = 'tutorial'), end: () => (shown = 'as before') },
    });
    tutorial.keepFor('tom', storage);
  });

  const look = () => {
    eye = { towardsEye: new Vector3(0, 1, 0), distanceMm: 120 };
    tell({});
  };

  it('begins beside the plan with a gentle push, once the picture is there', async () => {
    await tutorial.start();
    expect(made).toEqual(['a']);
    expect(practiceStore.offPlanMm.value).toBe(0);
    picture('a');
    expect(tutorial.stepName.value).toBe('look');
    expect(practiceStore.offPlanMm.value).toBeGreaterThan(5);
    expect(practiceStore.hand.levelN.value).toBe(12);
    look();
    expect(tutorial.stepName.value).toBe('aim');
  });

  it('asks for nothing before the picture is there, whose coming turns it', async () => {
    await tutorial.start();
    expect(tutorial.begun.value).toBe(false);
    look();
    picture('a');
    expect(tutorial.begun.value).toBe(true);
    expect(tutorial.stepName.value).toBe('look');
    await tutorial.again();
    expect(tutorial.begun.value).toBe(false);
    picture('b');
    expect(tutorial.begun.value).toBe(true);
  });

  it('keeps the reamer on the plan once it has been brought there', async () => {
    await tutorial.start();
    picture('a');
    look();
    practiceStore.hand.putAt({ superior: 0.5, anterior: 0 }, false);
    tell({});
    expect(tutorial.stepName.value).toBe('spindle');
    practiceStore.hand.putAt({ superior: 9, anterior: 0 }, false);
    practiceStore.hand.forgetHover();
    expect(practiceStore.offPlanMm.value).toBe(0.5);
  });

  it('goes through to the result, and is remembered for this person', async () => {
    const { hand } = practiceStore;
    await tutorial.start();
    picture('a');
    look();
    hand.goHome();
    hand.toggleSpindle();
    hand.toggleIrrigation();
    tell({ spindleOn: true });
    const cutting = { spindleOn: true, densityGCc: 1 };
    hand.push('keys', 1);
    hand.step(1);
    tell({ ...cutting, thrustN: Float32Array.of(11, 12) });
    tell({ ...cutting, thrustN: Float32Array.of(50, 54), depthMm: 0.8 });
    expect(tutorial.stepName.value).toBe('stop');
    hand.push('keys', 0);
    tell({ ...cutting, thrustN: Float32Array.of(1), depthMm: 2.1, worldFromTool: at(2) });
    tell({ spindleOn: true, depthMm: 2.1, worldFromTool: at(-3) });
    expect(tutorial.stepName.value).toBe('result');
    expect(tutorial.remembered.value).toBeNull();
    end('stopped');
    expect(tutorial.step.value).toBe(stepNames.length);
    expect(tutorial.astray.value).toBeNull();
    expect(tutorial.remembered.value).toBe('finished');
    tutorial.close();
    expect(hand.levelN.value).toBe(52);
    expect([...kept]).toEqual([['ream.tutorial.tom', 'finished']]);
    tutorial.keepFor('ann', storage);
    expect(tutorial.remembered.value).toBeNull();
  });

  it('is skipped with the reamer in the hand, and that is remembered', async () => {
    await tutorial.start();
    picture('a');
    tutorial.skip();
    expect(tutorial.session.value).toBeNull();
    expect(practiceStore.steering.value).toBe(true);
    expect(practiceStore.hand.levelN.value).toBe(52);
    expect(kept.get('ream.tutorial.tom')).toBe('skipped');
  });

  it('says that it was too deep, and starts again on intact bone', async () => {
    await tutorial.start();
    picture('a');
    tell({ depthMm: 2.4 });
    expect(tutorial.astray.value).toBe('tooDeep');
    await tutorial.again();
    expect(resets).toBe(1);
    expect(made).toEqual(['a', 'b']);
    picture('b');
    tell({});
    expect(tutorial.session.value).toBe('b');
    expect(tutorial.astray.value).toBeNull();
  });

  it('starts another session where the old one has ended, and where a reset waits to be started', async () => {
    practiceStore.hand.setLevel(40);
    await tutorial.start();
    picture('a');
    end('stopped');
    expect(tutorial.astray.value).toBe('endedEarly');
    await tutorial.again();
    expect([resets, tutorial.session.value, made]).toEqual([0, 'd', ['a', 'd']]);
    picture('d');
    expect(tutorial.astray.value).toBeNull();
    resetState = 'created';
    practised = ['e'];
    await tutorial.again();
    expect([resets, tutorial.session.value, practiceStore.sessionId.value]).toEqual([1, 'e', 'e']);
    picture('e');
    tutorial.skip();
    expect(practiceStore.hand.levelN.value).toBe(40);
  });

  it('is never gone in between while it starts again', async () => {
    await tutorial.start();
    picture('a');
    end('stopped');
    const sessions: (string | null)[] = [];
    tutorial.session.subscribe((id) => sessions.push(id));
    await tutorial.again();
    expect(sessions).toEqual(['a', 'd']);
  });

  it('does nothing to a session in another hand', async () => {
    await tutorial.start();
    picture('a');
    practiceStore.sessionId.value = null;
    expect(tutorial.astray.value).toBe('notInHand');
    await tutorial.stop();
    await tutorial.again();
    expect([stops, resets, tutorial.session.value]).toEqual([0, 0, 'd']);
    picture('d');
    await tutorial.stop();
    expect(stops).toBe(1);
  });

  it('does not judge a replay, nor stop it', async () => {
    await tutorial.start();
    picture('a');
    batch(() => {
      store.replayId.value = 'r';
      store.sessionId.value = 'r';
      store.sessionState.value = 'replaying';
      practiceStore.sessionId.value = null;
    });
    expect([tutorial.session.value, tutorial.astray.value]).toEqual(['a', null]);
    await tutorial.stop();
    expect(stops).toBe(0);
  });

  it('says before the picture is there that the session has ended, or that the hand was refused', async () => {
    await tutorial.start();
    expect(tutorial.astray.value).toBeNull();
    practiceStore.sessionId.value = null;
    expect(tutorial.astray.value).toBe('notInHand');
    store.sessionState.value = 'fault';
    expect(tutorial.astray.value).toBe('endedEarly');
  });

  it('shows the reamer, and gives the picture back at the end', async () => {
    store.reamerShown.value = false;
    await tutorial.start();
    picture('a');
    expect([shown, store.reamerShown.value]).toEqual(['tutorial', true]);
    tutorial.skip();
    expect(shown).toBe('as before');
  });

  it('works in a browser that lets nothing be read', () => {
    const none = () => {
      throw new Error('denied');
    };
    tutorial.keepFor('ann', { getItem: none, setItem: none });
    expect(tutorial.remembered.value).toBeNull();
  });

  it('goes along when its session is begun anew elsewhere, and ends with another in the picture', async () => {
    await tutorial.start();
    picture('a');
    look();
    await make('b', 'a');
    expect(tutorial.session.value).toBe('a');
    practiceStore.sessionId.value = 'b';
    expect(tutorial.session.value).toBe('b');
    expect(tutorial.stepName.value).toBe('look');
    await make('c');
    expect(tutorial.session.value).toBeNull();
    expect(tutorial.remembered.value).toBeNull();
  });
});

/** So far past the planned entry, on the axis. */
const at = (depthMm: number) => ({
  rotationXyzw: [0, Math.SQRT1_2, 0, Math.SQRT1_2] as const,
  translationMm: [depthMm, 0, 0] as const,
});
