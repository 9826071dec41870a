import { describe, expect, it } from 'vitest';

import { FilePlayback } from '../../src/review_file/file_playback';

describe('The playback of a review file', () => {
  it('rests at the start, moves on by its speed, and rests at the end', () => {
    const playback = new FilePlayback(1000);
    playback.advance(500);
    expect(playback.now).toEqual({ positionTicks: 0, speed: 1, playing: false, jump: 0 });
    playback.change({ playing: true, speed: 2 });
    playback.advance(100);
    expect(playback.now).toMatchObject({ positionTicks: 200, playing: true });
    playback.advance(100);
    expect(playback.now).toMatchObject({ positionTicks: 400, playing: true });
    for (let i = 0; i < 10; ++i) playback.advance(100);
    expect(playback.now).toMatchObject({ positionTicks: 1000, playing: false, speed: 2 });
  });

  it('begins at the start again where it is played from the end', () => {
    const playback = new FilePlayback(1000);
    playback.change({ position_s: 5 });
    expect(playback.now.positionTicks).toBe(1000);
    playback.change({ playing: true });
    expect(playback.now).toMatchObject({ positionTicks: 0, playing: true, jump: 2 });
  });

  it('goes where it is told and no further than there is, counting jumps', () => {
    const playback = new FilePlayback(1000);
    playback.change({ position_s: 0.25 });
    playback.change({ position_s: -1 });
    expect(playback.now).toMatchObject({ positionTicks: 0, jump: 2 });
  });

  it('is at the very tick that is sought, the last one, too', () => {
    for (let tick = 0; tick <= 30_000; ++tick) {
      const playback = new FilePlayback(30_000);
      playback.change({ position_s: tick / 1000 });
      expect(playback.now.positionTicks).toBe(tick);
    }
    const odd = new FilePlayback(1001);
    odd.change({ position_s: 1001 / 1000 });
    odd.change({ playing: true });
    expect(odd.now).toMatchObject({ positionTicks: 0, playing: true });
  });

  it('does not pass over what nobody saw, of a computer that slept', () => {
    const playback = new FilePlayback(100_000);
    playback.change({ playing: true });
    playback.advance(60_000);
    expect(playback.now.positionTicks).toBeLessThan(1000);
  });

  it('rests at speed 0 and keeps the one it had', () => {
    const playback = new FilePlayback(1000);
    playback.change({ playing: true, speed: 4 });
    playback.change({ speed: 0 });
    expect(playback.now).toMatchObject({ playing: false, speed: 4 });
  });
});
