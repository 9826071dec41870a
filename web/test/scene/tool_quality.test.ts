import { describe, expect, it } from 'vitest';

import { ToolQuality } from '../../src/scene/tool_quality';

function draw(quality: ToolQuality, pictures: number, ms: number): void {
  for (let i = 0; i < pictures; ++i) quality.drawnAfter(ms);
}

describe('ToolQuality', () => {
  it('begins with what draws', () => {
    expect(new ToolQuality(false).full.value).toBe(true);
    expect(new ToolQuality(true).full.value).toBe(false);
  });

  it('is plain once pictures take too long, and stays so', () => {
    const quality = new ToolQuality(false);
    draw(quality, 300, 24);
    expect(quality.full.value).toBe(true);
    draw(quality, 59, 26);
    expect(quality.full.value).toBe(true);
    draw(quality, 1, 26);
    expect(quality.full.value).toBe(false);
    draw(quality, 300, 5);
    expect(quality.full.value).toBe(false);
  });

  it('takes no offence at some slow pictures, or at a page that was not seen', () => {
    const quality = new ToolQuality(false);
    for (let i = 0; i < 10; ++i) {
      draw(quality, 35, 16);
      draw(quality, 25, 200);
    }
    draw(quality, 200, 5000);
    expect(quality.full.value).toBe(true);
  });

  it('is what was chosen, however long that takes', () => {
    const quality = new ToolQuality(true);
    quality.choose('full');
    draw(quality, 300, 100);
    expect(quality.full.value).toBe(true);
    quality.choose('plain');
    expect(quality.full.value).toBe(false);
  });

  it('tries again when automatic is chosen again', () => {
    const quality = new ToolQuality(false);
    draw(quality, 60, 40);
    quality.choose('automatic');
    expect(quality.full.value).toBe(false);
    quality.choose('plain');
    quality.choose('automatic');
    expect(quality.full.value).toBe(true);
  });
});
