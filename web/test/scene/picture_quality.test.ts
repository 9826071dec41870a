import { describe, expect, it } from 'vitest';

import { PictureQuality } from '../../src/scene/picture_quality';

function draw(quality: PictureQuality, pictures: number, ms: number): void {
  for (let i = 0; i < pictures; ++i) quality.drawnAfter(ms);
}

describe('PictureQuality', () => {
  it('begins with what draws', () => {
    expect(new PictureQuality(false).level.value).toBe('fine');
    expect(new PictureQuality(true).level.value).toBe('plain');
  });

  it('goes down level by level while pictures take too long, and stays there', () => {
    const quality = new PictureQuality(false);
    draw(quality, 300, 24);
    expect(quality.level.value).toBe('fine');
    draw(quality, 59, 26);
    expect(quality.level.value).toBe('fine');
    draw(quality, 1, 26);
    expect(quality.level.value).toBe('full');
    expect(quality.full.value).toBe(true);
    draw(quality, 300, 5);
    expect(quality.level.value).toBe('full');
    draw(quality, 60, 26);
    expect(quality.level.value).toBe('plain');
    expect(quality.full.value).toBe(false);
    draw(quality, 300, 100);
    expect(quality.level.value).toBe('plain');
  });

  it('takes no offence at some slow pictures, or at a page that was not seen', () => {
    const quality = new PictureQuality(false);
    for (let i = 0; i < 10; ++i) {
      draw(quality, 35, 16);
      draw(quality, 25, 200);
    }
    draw(quality, 200, 5000);
    expect(quality.level.value).toBe('fine');
  });

  it('is what was chosen, however long that takes', () => {
    const quality = new PictureQuality(true);
    for (const level of ['fine', 'full', 'plain'] as const) {
      quality.choose(level);
      draw(quality, 300, 100);
      expect(quality.level.value).toBe(level);
    }
  });

  it('tries again when automatic is chosen again', () => {
    const quality = new PictureQuality(false);
    draw(quality, 120, 40);
    quality.choose('automatic');
    expect(quality.level.value).toBe('plain');
    quality.choose('plain');
    quality.choose('automatic');
    expect(quality.level.value).toBe('fine');
  });
});
