import { beforeEach, describe, expect, it } from 'vitest';

import { Hand, levelStepN, withdrawN } from '../../src/practice/hand';
import { KeyHand } from '../../src/practice/key_hand';
import { PlanFrame } from '../../src/practice/plan_frame';
import { FakeSurface, FakeView } from './fake_surface';

const plan = new PlanFrame({ axisEntryMm: [5, 6, 7], axisDirection: [-1, 0, 0] });

describe('KeyHand', () => {
  let hand: Hand;
  let keys: KeyHand;
  let surface: FakeSurface;
  let view: FakeView;
  let practised: PlanFrame | null;
  beforeEach(() => {
    hand = new Hand();
    surface = new FakeSurface();
    view = new FakeView(plan);
    practised = plan;
    keys = new KeyHand(surface as never, hand, view, () => practised);
  });
  const wait = (seconds: number) => {
    for (let i = 0; i < seconds / 0.01; ++i) {
      keys.step(0.01);
      hand.step(0.01);
    }
  };
  const tap = (key: string) => {
    surface.fire('keydown', { key });
    surface.fire('keyup', { key });
  };

  it('moves the tool on the picture while an arrow is down, and leans it with Shift', () => {
    surface.fire('keydown', { key: 'ArrowRight' });
    wait(0.5);
    surface.fire('keyup', { key: 'ArrowRight' });
    const { anterior, superior } = hand.place.value;
    expect(anterior).toBeCloseTo(4, 6);
    expect(superior).toBeCloseTo(0, 9);
    wait(0.5);
    expect(hand.place.value.anterior).toBe(anterior);
    surface.fire('keydown', { key: 'ArrowUp', shiftKey: true });
    wait(0.2);
    surface.fire('keyup', { key: 'ArrowUp', shiftKey: true });
    expect(hand.lean.value.superior).toBeCloseTo(2, 6);
    expect(hand.place.value.anterior).toBe(anterior);
  });

  it('zooms by Page up and Page down, and takes hold of nothing by that', () => {
    hand.letGo();
    expect(surface.fire('keydown', { key: 'PageUp' })).toBe(true);
    expect(surface.fire('keydown', { key: 'PageDown' })).toBe(true);
    expect(view.zoomed[0]).toBeLessThan(1);
    expect(view.zoomed[1]).toBeGreaterThan(1);
    expect(hand.held.value).toBe(false);
  });

  it('pushes by space and withdraws by B or Backspace while they are down', () => {
    expect(surface.fire('keydown', { key: ' ' })).toBe(true);
    surface.fire('keydown', { key: ' ', repeat: true });
    wait(1);
    expect(hand.pushN.value).toBe(hand.levelN.value);
    surface.fire('keyup', { key: ' ' });
    expect(hand.pushN.value).toBe(0);
    for (const key of ['b', 'B', 'Backspace']) {
      surface.fire('keydown', { key });
      wait(0.1);
      expect(hand.pushN.value).toBe(-withdrawN);
      surface.fire('keyup', { key });
      wait(0.1);
      expect(hand.pushN.value).toBe(0);
    }
  });

  it('switches spindle and irrigation, rests, changes the level and goes back to the plan', () => {
    tap('s');
    expect(hand.spindleOn.value).toBe(true);
    surface.fire('keydown', { key: 's', repeat: true });
    expect(hand.spindleOn.value).toBe(true);
    tap('i');
    expect(hand.irrigating.value).toBe(true);
    tap('I');
    expect(hand.irrigating.value).toBe(false);
    tap('p');
    expect(hand.paused.value).toBe(true);
    const before = hand.levelN.value;
    tap('+');
    tap('-');
    tap('-');
    expect(hand.levelN.value).toBe(before - levelStepN);
    hand.putAt({ superior: 3, anterior: 3 }, true);
    hand.leanTo({ superior: 3, anterior: 3 });
    tap('Home');
    expect(hand.place.value).toEqual({ superior: 0, anterior: 0 });
    expect(hand.lean.value).toEqual({ superior: 0, anterior: 0 });
  });

  it('stops all when the picture loses the keys', () => {
    surface.fire('keydown', { key: ' ' });
    surface.fire('keydown', { key: 'ArrowLeft' });
    wait(1);
    surface.fire('blur', {});
    const { anterior } = hand.place.value;
    wait(1);
    expect(hand.pushN.value).toBe(0);
    expect(hand.place.value.anterior).toBe(anterior);
  });

  it('turns the view by Ctrl and arrows; leaves other keys, and all keys when nothing is practised', () => {
    expect(surface.fire('keydown', { key: 'ArrowLeft', ctrlKey: true })).toBe(true);
    expect(view.turned).toHaveLength(1);
    wait(0.2);
    expect(hand.place.value).toEqual({ superior: 0, anterior: 0 });
    for (const event of [{ key: 'Tab' }, { key: 'r', ctrlKey: true }, { key: 'ArrowLeft', altKey: true }])
      expect(surface.fire('keydown', event)).toBe(false);
    practised = null;
    expect(surface.fire('keydown', { key: ' ' })).toBe(false);
    wait(0.2);
    expect(hand.pushN.value).toBe(0);
  });
});
