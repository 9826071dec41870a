import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

import { allDrawn, FrameRequest } from '../../src/scene/frame_request';

describe('FrameRequest', () => {
  let drawn: number;
  let request: FrameRequest;

  beforeEach(() => {
    vi.useFakeTimers();
    vi.stubGlobal('requestAnimationFrame', (draw: () => void) => setTimeout(draw, 16));
    vi.stubGlobal('cancelAnimationFrame', (frame: ReturnType<typeof setTimeout>) => clearTimeout(frame));
    drawn = 0;
    request = new FrameRequest(() => ++drawn);
  });
  afterEach(() => {
    request.dispose();
    vi.unstubAllGlobals();
    vi.useRealTimers();
  });

  it('draws once what was asked for several times', () => {
    request.request();
    request.request();
    vi.advanceTimersByTime(100);
    expect(drawn).toBe(1);
    expect(request.isWaiting).toBe(false);
  });

  it.each(['before', 'after'] as const)('draws what was asked for %s a hold when that ends', (when) => {
    if (when === 'before') request.request();
    request.hold(500);
    if (when === 'after') request.request();
    vi.advanceTimersByTime(400);
    expect(drawn).toBe(0);
    expect(request.isWaiting, 'not all is drawn').toBe(true);
    request.release();
    vi.advanceTimersByTime(20);
    expect(drawn).toBe(1);
    vi.advanceTimersByTime(1000);
    expect(drawn).toBe(1);
  });

  it('is held for no longer than was said', () => {
    request.hold(300);
    request.hold(500);
    request.request();
    vi.advanceTimersByTime(480);
    expect(drawn).toBe(0);
    vi.advanceTimersByTime(60);
    expect(drawn).toBe(1);
  });

  it('draws nothing after a hold that nobody asked for', async () => {
    request.hold(100);
    vi.advanceTimersByTime(1000);
    expect(drawn).toBe(0);
    await allDrawn();
    request.hold(100);
    request.request();
    request.dispose();
    vi.advanceTimersByTime(1000);
    expect(drawn).toBe(0);
  });
});
