import { describe, expect, it } from 'vitest';

import { DelayWindow, Latency } from '../../src/state/latency';

describe('the newest delays', () => {
  it('say what 95 of 100 stay under, and nothing while there are few', () => {
    const window = new DelayWindow();
    for (let i = 1; i <= 9; ++i) window.add(i, 0);
    expect(window.p95(0)).toBeNull();
    for (let i = 10; i <= 100; ++i) window.add(i, 0);
    expect(window.p95(0)).toBe(95);
  });

  it('forget what is old, and hold no more than they can', () => {
    const window = new DelayWindow();
    for (let i = 0; i < 100; ++i) window.add(500, 0);
    for (let i = 0; i < 50; ++i) window.add(20, 15_000);
    expect(window.p95(15_000)).toBe(500);
    expect(window.p95(21_000)).toBe(20);
    expect(window.p95(60_000)).toBeNull();
    for (let i = 0; i < 5000; ++i) window.add(7, 60_000);
    expect(window.p95(60_000)).toBe(7);
  });
});

describe('the latency of the picture', () => {
  it('goes from the hand to the first picture that can show what it did', () => {
    const latency = new Latency();
    for (let i = 0; i < 20; ++i) {
      const at = i * 100;
      latency.taken({ sentMs: at, tick: i * 100 + 10 });
      latency.drawn(i * 100 + 9, at + 25, at + 30);
      latency.drawn(i * 100 + 40, at + 60, at + 66);
    }
    latency.publish(2000);
    expect(latency.handMs.value).toBe(66);
    expect(latency.drawingMs.value).toBe(6);
  });

  it('does not count the rest of a hand for which nothing had to be drawn', () => {
    const latency = new Latency();
    for (let i = 0; i < 500; ++i) {
      latency.taken({ sentMs: i * 10, tick: i * 10 });
      latency.shows(i * 10);
    }
    for (let i = 500; i < 520; ++i) {
      latency.taken({ sentMs: i * 10, tick: i * 10 });
      latency.drawn(i * 10, i * 10 + 5, i * 10 + 30);
    }
    latency.publish(5200);
    expect(latency.handMs.value).toBe(30);
  });

  it('counts a picture of a tick once', () => {
    const latency = new Latency();
    for (let i = 0; i < 40; ++i) latency.drawn(5, 0, i * 10);
    latency.publish(400);
    expect(latency.drawingMs.value).toBeNull();
  });

  it('knows nothing of another session', () => {
    const latency = new Latency();
    for (let i = 0; i < 20; ++i) {
      latency.taken({ sentMs: i, tick: 1000 + i });
      latency.drawn(1000 + i, i, i + 9);
    }
    latency.publish(30);
    expect(latency.handMs.value).toBe(9);
    latency.taken({ sentMs: 30, tick: 1030 });
    latency.forget();
    expect(latency.handMs.value).toBeNull();
    for (let i = 0; i < 20; ++i) latency.drawn(5000 + i, 900, 901);
    latency.publish(901);
    expect(latency.handMs.value).toBeNull();
  });
});
