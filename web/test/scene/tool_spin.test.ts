import { describe, expect, it } from 'vitest';

import { Spin } from '../../src/scene/tool_spin';
import { fullSpindleRadS } from '../../src/wire/telemetry';

const pitch = (2 * Math.PI) / 5;

/** After a second of pictures. */
function turning(picturesPerS: number, speedRadS: number): Spin {
  const spin = new Spin(pitch);
  for (let i = 0; i <= picturesPerS; ++i) spin.turn(1 / picturesPerS, speedRadS);
  return spin;
}

describe('Spin', () => {
  it('turns as fast as the spindle, either way', () => {
    expect(turning(60, 1.5).angle).toBeCloseTo(1.5, 9);
    expect(turning(60, -1.5).angle).toBeCloseTo(-1.5, 9);
  });

  it('shows blades while they turn slowly', () => {
    expect(turning(60, 0.3 * fullSpindleRadS).blur).toBe(0);
    expect(turning(60, fullSpindleRadS).blur).toBeLessThan(0.3);
  });

  it('shows no blade wherever one would seem to stand or to turn back', () => {
    for (const pictures of [10, 15, 24, 30, 60])
      for (let speed = 0.5; speed < 400; speed *= 1.1) {
        const bladesPassed = speed / pictures / pitch;
        const { blur } = turning(pictures, speed);
        if (bladesPassed > 0.45) expect(blur).toBe(1);
        if (bladesPassed < 0.19) expect(blur).toBe(0);
        expect(turning(pictures, -speed).blur).toBe(blur);
      }
  });

  it('stands at once, and begins without a jump or a flash', () => {
    const spin = turning(30, fullSpindleRadS);
    const { angle } = spin;
    spin.stand();
    expect([spin.angle, spin.blur]).toEqual([angle, 0]);
    // The first picture after a rest is long after the last one.
    spin.turn(0.1, 2);
    expect([spin.angle, spin.blur]).toEqual([angle, 0]);
    spin.turn(1 / 60, 2);
    expect(spin.angle).toBeCloseTo((angle + 2 / 60) % (2 * Math.PI), 9);
  });
});
