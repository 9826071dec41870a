import { beforeEach, describe, expect, it } from 'vitest';

import { Hand, levelStepN, withdrawN } from '../../src/practice/hand';
import { PlanFrame } from '../../src/practice/plan_frame';
import { PointerHand } from '../../src/practice/pointer_hand';
import { FakeSurface, FakeView } from './fake_surface';

const plan = new PlanFrame({ axisEntryMm: [5, 6, 7], axisDirection: [-1, 0, 0] });

describe('PointerHand', () => {
  let hand: Hand;
  let surface: FakeSurface;
  let view: FakeView;
  let practised: PlanFrame | null;
  beforeEach(() => {
    hand = new Hand();
    surface = new FakeSurface();
    view = new FakeView(plan);
    practised = plan;
    new PointerHand(surface as never, hand, view, () => practised);
  });
  const pushN = () => {
    for (let i = 0; i < 100; ++i) hand.step(0.016);
    return hand.pushN.value;
  };
  const place = () => [hand.place.value.anterior, hand.place.value.superior].map((mm) => Math.round(mm * 1e6) / 1e6);

  it('places the tool under the mouse and pushes while the left button is down', () => {
    surface.fire('pointermove', { clientX: 250, clientY: 180 });
    expect(place()).toEqual([5, 2]);
    expect(pushN()).toBe(0);
    surface.fire('pointerdown', { clientX: 250, clientY: 180, buttons: 1 });
    expect(pushN()).toBe(hand.levelN.value);
    surface.fire('pointermove', { clientX: 240, clientY: 180, buttons: 1 });
    expect(place()).toEqual([4, 2]);
    surface.fire('pointerup', { clientX: 240, clientY: 180 });
    expect(hand.pushN.value).toBe(0);
  });

  it('withdraws by the right button, or by the left one with Shift', () => {
    surface.fire('pointerdown', { button: 2, buttons: 2 });
    expect(pushN()).toBe(-withdrawN);
    surface.fire('pointerup', { button: 2 });
    expect(pushN()).toBe(0);
    surface.fire('pointerdown', { shiftKey: true, buttons: 1 });
    expect(pushN()).toBe(-withdrawN);
    expect(surface.fire('contextmenu', {})).toBe(true);
  });

  it('stops when the button that pushed goes up, though another one is still down', () => {
    surface.fire('pointerdown', { buttons: 1 });
    surface.fire('pointermove', { buttons: 3 });
    expect(pushN()).toBe(hand.levelN.value);
    surface.fire('pointermove', { buttons: 2 });
    expect(hand.pushN.value).toBe(0);
    expect(pushN()).toBe(0);
  });

  it('lets go when the pointer slips off while it presses', () => {
    for (const [type, at] of [
      ['pointermove', { clientX: 450, buttons: 1 }],
      ['pointerleave', { clientX: 401, buttons: 1 }],
    ] as const) {
      hand.takeHold();
      if (!hand.spindleOn.value) hand.toggleSpindle();
      surface.fire('pointerdown', { buttons: 1 });
      surface.fire(type, at);
      expect(hand.input(plan)).toMatchObject({ pushN: 0, spindleOn: false, held: false });
      expect(pushN()).toBe(0);
    }
    surface.fire('pointermove', {});
    expect(hand.held.value).toBe(true);
    expect(pushN()).toBe(0);
  });

  it('goes back to where the tool was pressed when the mouse leaves without pressing', () => {
    surface.fire('pointerdown', { clientX: 210, buttons: 1 });
    surface.fire('pointerup', { clientX: 210 });
    surface.fire('pointermove', { clientX: 399 });
    surface.fire('pointerleave', { clientX: 401 });
    expect(place()).toEqual([1, 0]);
    expect(hand.held.value).toBe(true);
  });

  it('turns by Ctrl or the middle button and leans by Alt, and neither pushes nor places', () => {
    surface.fire('pointerdown', { ctrlKey: true, buttons: 1 });
    surface.fire('pointermove', { clientX: 210, clientY: 195, ctrlKey: true, buttons: 1 });
    surface.fire('pointerup', { clientX: 210, clientY: 195 });
    expect(surface.fire('pointerdown', { button: 1, buttons: 4 })).toBe(true);
    surface.fire('pointermove', { clientX: 190, buttons: 4 });
    surface.fire('pointerup', { button: 1 });
    expect(view.turned).toEqual([
      [10, -5],
      [-10, 0],
    ]);
    surface.fire('pointerdown', { altKey: true, buttons: 1 });
    surface.fire('pointermove', { clientX: 240, altKey: true, buttons: 1 });
    surface.fire('pointerup', { clientX: 240 });
    expect(hand.lean.value.anterior).toBeCloseTo(6, 9);
    expect(hand.lean.value.superior).toBeCloseTo(0, 9);
    expect(place()).toEqual([0, 0]);
    expect(pushN()).toBe(0);
  });

  it('changes the level by the wheel, and zooms with Ctrl', () => {
    const before = hand.levelN.value;
    expect(surface.fire('wheel', { deltaY: -120 })).toBe(true);
    expect(hand.levelN.value).toBe(before + levelStepN);
    surface.fire('wheel', { deltaY: 3, ctrlKey: true });
    expect(view.zoomed).toHaveLength(1);
    expect(view.zoomed[0]).toBeGreaterThan(1);
    expect(hand.levelN.value).toBe(before + levelStepN);
  });

  it('places by the first finger and pushes while a second one is down', () => {
    const first = { pointerType: 'touch', pointerId: 11 };
    const second = { pointerType: 'touch', pointerId: 12, clientX: 20, clientY: 20 };
    surface.fire('pointerdown', { ...first, clientX: 230, buttons: 1 });
    expect(place()).toEqual([3, 0]);
    expect(pushN()).toBe(0);
    surface.fire('pointerdown', { ...second, buttons: 1 });
    expect(pushN()).toBe(hand.levelN.value);
    surface.fire('pointermove', { ...second, clientX: 60, buttons: 1 });
    surface.fire('pointermove', { ...first, clientX: 220, buttons: 1 });
    expect(place()).toEqual([2, 0]);
    expect(pushN()).toBe(hand.levelN.value);
    surface.fire('pointerup', second);
    expect(hand.pushN.value).toBe(0);
    // The first finger goes up before the second: the second does not become the one that places.
    surface.fire('pointerdown', { ...second, buttons: 1 });
    surface.fire('pointerup', first);
    expect(hand.pushN.value).toBe(0);
    surface.fire('pointermove', { ...second, clientX: 390, buttons: 1 });
    expect(place()).toEqual([2, 0]);
  });

  it('leaves everything alone while nothing is practised', () => {
    practised = null;
    surface.fire('pointermove', { clientX: 300 });
    surface.fire('pointerdown', { buttons: 1 });
    expect(surface.fire('wheel', { deltaY: 1 })).toBe(false);
    expect(surface.fire('contextmenu', {})).toBe(false);
    expect(place()).toEqual([0, 0]);
    expect(pushN()).toBe(0);
  });
});
