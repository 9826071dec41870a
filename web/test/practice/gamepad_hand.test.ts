import { beforeEach, describe, expect, it } from 'vitest';

import { GamepadHand, type PadState, type ScreenAxes } from '../../src/practice/gamepad_hand';
import { Hand, withdrawN } from '../../src/practice/hand';
import { Rumble, weakMagnitude } from '../../src/practice/rumble';

const screen: ScreenAxes = { right: { superior: 0, anterior: 1 }, up: { superior: 1, anterior: 0 } };

function pad(axes: number[], pressed: Record<number, number> = {}): PadState {
  const buttons = Array.from({ length: 17 }, (_, i) => ({ pressed: (pressed[i] ?? 0) > 0.1, value: pressed[i] ?? 0 }));
  return { axes, buttons };
}

describe('GamepadHand', () => {
  let hand: Hand;
  let gamepad: GamepadHand;
  beforeEach(() => {
    hand = new Hand();
    gamepad = new GamepadHand(hand);
  });

  it('places by the left stick and leans by the right one, up being up', () => {
    for (let i = 0; i < 50; ++i) expect(gamepad.step(pad([1, 0, 0, 0]), 0.01, screen)).toBe(true);
    expect(hand.place.value.anterior).toBeCloseTo(7, 6);
    expect(hand.place.value.superior).toBeCloseTo(0, 9);
    for (let i = 0; i < 50; ++i) gamepad.step(pad([0, 0, 0, -1]), 0.01, screen);
    expect(hand.lean.value.superior).toBeCloseTo(7, 6);
  });

  it('takes a stick that hangs a little for one that rests', () => {
    expect(gamepad.step(pad([0.09, -0.08, 0.05, 0.1]), 1, screen)).toBe(false);
    expect(hand.place.value).toEqual({ superior: 0, anterior: 0 });
    expect(hand.lean.value).toEqual({ superior: 0, anterior: 0 });
  });

  it('pushes by the right trigger as far as it is pressed, and withdraws by the left one', () => {
    hand.setLevel(60);
    gamepad.step(pad([0, 0, 0, 0], { 7: 0.5 }), 0.01, screen);
    for (let i = 0; i < 100; ++i) hand.step(0.016);
    expect(hand.pushN.value).toBeCloseTo(30, 6);
    gamepad.step(pad([0, 0, 0, 0], { 6: 1 }), 0.01, screen);
    hand.step(0.016);
    expect(hand.pushN.value).toBe(-withdrawN);
  });

  it('switches spindle and pause once a press', () => {
    for (let i = 0; i < 3; ++i) gamepad.step(pad([0, 0, 0, 0], { 0: 1 }), 0.01, screen);
    expect(hand.spindleOn.value).toBe(true);
    gamepad.step(pad([0, 0, 0, 0]), 0.01, screen);
    gamepad.step(pad([0, 0, 0, 0], { 0: 1, 1: 1 }), 0.01, screen);
    expect(hand.spindleOn.value).toBe(false);
    expect(hand.paused.value).toBe(true);
  });

  it('pushes no more when it is unplugged', () => {
    gamepad.step(pad([0, 0, 0, 0], { 7: 1 }), 0.01, screen);
    hand.step(1);
    expect(hand.pushN.value).toBeGreaterThan(0);
    gamepad.step(null, 0.01, screen);
    expect(hand.pushN.value).toBe(0);
  });
});

describe('rumble', () => {
  it('maps the published accelerations to the weak motor', () => {
    expect(weakMagnitude(0)).toBe(0);
    expect(weakMagnitude(0.15)).toBeCloseTo(0.375, 12);
    expect(weakMagnitude(0.3)).toBeCloseTo(0.75, 12);
    expect(weakMagnitude(0.4)).toBeCloseTo(1, 12);
    expect(weakMagnitude(5)).toBe(1);
    expect(weakMagnitude(NaN)).toBe(0);
  });

  it('feels the root mean square of what swings, asks anew every 80 ms, and does without a motor', () => {
    const effects: { duration: number; weakMagnitude: number }[] = [];
    const motor = {
      playEffect: (_type: 'dual-rumble', effect: { duration: number; weakMagnitude: number }) => {
        effects.push(effect);
        return Promise.resolve('complete');
      },
    };
    const rumble = new Rumble();
    for (let i = 0; i < 200; ++i) rumble.feel(i % 2 === 0 ? 0.4 : -0.4);
    for (let ms = 0; ms < 400; ms += 16) rumble.play(motor, ms);
    expect(effects).toHaveLength(5);
    expect(effects[0]?.duration).toBe(100);
    expect(effects[0]?.weakMagnitude).toBeCloseTo(1, 6);
    rumble.play(undefined, 1000);
    rumble.forget();
    rumble.play(motor, 2000);
    expect(effects).toHaveLength(5);
  });
});
