import { beforeEach, describe, expect, it } from 'vitest';

import { Hand, levelLeastN, levelMostN, withdrawN } from '../../src/practice/hand';
import { leanMaxDeg, PlanFrame, sidewaysMaxMm } from '../../src/practice/plan_frame';

const plan = new PlanFrame({ axisEntryMm: [0, 0, 0], axisDirection: [-1, 0, 0] });

describe('Hand', () => {
  let hand: Hand;
  beforeEach(() => (hand = new Hand()));
  const wait = (seconds: number) => {
    for (let i = 0; i < seconds / 0.016; ++i) hand.step(0.016);
  };

  it('lets a push rise smoothly to the level and end at once', () => {
    hand.setLevel(50);
    hand.push('mouse', 1);
    let before = 0;
    for (let i = 0; i < 60; ++i) {
      hand.step(0.01);
      expect(hand.pushN.value).toBeGreaterThanOrEqual(before);
      expect(hand.pushN.value - before).toBeLessThan(2);
      before = hand.pushN.value;
    }
    expect(hand.pushN.value).toBe(50);
    hand.push('mouse', 0);
    expect(hand.input(plan).pushN).toBe(0);
  });

  it('pushes while any one does, as hard as the hardest, and withdraws before all', () => {
    hand.setLevel(40);
    hand.push('keys', 1);
    hand.push('gamepad', 0.5);
    wait(1);
    expect(hand.pushN.value).toBe(40);
    hand.push('keys', 0);
    wait(0.1);
    expect(hand.pushN.value).toBe(20);
    hand.withdraw('mouse', 1);
    expect(hand.pushN.value).toBe(0);
    wait(0.1);
    expect(hand.pushN.value).toBe(-withdrawN);
    hand.withdraw('mouse', 0);
    wait(1);
    expect(hand.pushN.value).toBe(20);
  });

  it('keeps level, place and lean within what a hand may', () => {
    hand.changeLevel(1000);
    expect(hand.levelN.value).toBe(levelMostN);
    hand.changeLevel(-1000);
    expect(hand.levelN.value).toBe(levelLeastN);
    hand.putAt({ superior: 90, anterior: 0 }, true);
    expect(hand.place.value).toEqual({ superior: sidewaysMaxMm, anterior: 0 });
    hand.leanTo({ superior: 0, anterior: -90 });
    expect(hand.lean.value).toEqual({ superior: 0, anterior: -leanMaxDeg });
    hand.setLevel(1e9);
    hand.push('gamepad', 7);
    wait(2);
    expect(hand.pushN.value).toBe(levelMostN);
  });

  it('starts where it is put beside the plan, and no key leads back to it', () => {
    const pose = { place: { superior: 3, anterior: -2 }, lean: { superior: -4, anterior: 1 } };
    hand.reset({ pose, ownPressure: false });
    hand.goHome();
    expect(hand.place.value).toEqual(pose.place);
    expect(hand.lean.value).toEqual(pose.lean);
    hand.setLevel(40);
    hand.takeHold();
    hand.push('mouse', 1);
    wait(60);
    expect(hand.pushN.value).toBe(40);

    hand.reset();
    expect(hand.place.value).toEqual({ superior: 0, anterior: 0 });
    expect(hand.lean.value).toEqual({ superior: 0, anterior: 0 });
    hand.putAt(pose.place, true);
    hand.goHome();
    expect(hand.place.value).toEqual({ superior: 0, anterior: 0 });
  });

  it('with a pressure of its own pushes harder the longer it pushes', () => {
    hand.reset({ pose: null, ownPressure: true });
    hand.setLevel(40);
    hand.takeHold();
    hand.push('mouse', 1);
    wait(2);
    expect(hand.pushN.value).toBeCloseTo(50, -1);
    hand.push('mouse', 0);
    hand.withdraw('mouse', 0);
    // As a page without a gamepad says at every step.
    hand.push('gamepad', 0);
    hand.withdraw('gamepad', 0);
    wait(0.5);
    expect(hand.pushN.value).toBeCloseTo(20, -1);
    hand.push('mouse', 1);
    wait(60);
    expect(hand.pushN.value).toBe(levelMostN);
    hand.withdraw('mouse', 1);
    wait(0.1);
    expect(hand.pushN.value).toBe(-withdrawN);
  });

  it('does nothing more once it lets go, and all has to be pressed anew', () => {
    hand.toggleSpindle();
    hand.push('mouse', 1);
    wait(1);
    expect(hand.input(plan)).toMatchObject({ spindleOn: true, held: true });
    hand.letGo();
    expect(hand.input(plan)).toMatchObject({ pushN: 0, spindleOn: false, held: false });
    wait(1);
    expect(hand.pushN.value).toBe(0);
    hand.takeHold();
    wait(1);
    expect(hand.input(plan)).toMatchObject({ pushN: 0, spindleOn: false, held: true });
  });

  it('irrigates until it is told otherwise, or a session begins', () => {
    hand.toggleIrrigation();
    hand.letGo();
    expect(hand.input(plan)).toMatchObject({ spindleOn: false, irrigating: true });
    hand.reset();
    expect(hand.input(plan)).toMatchObject({ irrigating: false });
  });

  it('does not push while it rests', () => {
    hand.push('mouse', 1);
    wait(1);
    hand.togglePause();
    expect(hand.input(plan)).toMatchObject({ pushN: 0, paused: true });
    hand.push('keys', 1);
    wait(1);
    expect(hand.pushN.value).toBe(0);
  });

  it('goes back from where it only hovered, not from where it was put or pushed', () => {
    hand.putAt({ superior: 3, anterior: 0 }, true);
    hand.putAt({ superior: 9, anterior: 9 }, false);
    hand.forgetHover();
    expect(hand.place.value).toEqual({ superior: 3, anterior: 0 });
    hand.putAt({ superior: 5, anterior: 1 }, false);
    hand.push('mouse', 1);
    hand.putAt({ superior: 0, anterior: 8 }, false);
    hand.forgetHover();
    expect(hand.place.value).toEqual({ superior: 5, anterior: 1 });
  });
});
