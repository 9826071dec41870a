import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';

import { operatingLightFor } from '../../src/scene/lights';

describe('operatingLightFor', () => {
  // A viewer on z, whose up is y: the lamp comes from (-0.55, 0.9, 1), the fill from (1, -0.1, 0.8).
  const light = operatingLightFor(new Vector3(0, 0, 1), new Vector3(0, 1, 0));
  const green = (x: number, y: number, z: number) => light(new Vector3(x, y, z)).g;
  // Greens of the colours 0xfff6e8, 0xe4edf6, 0xffffff and 0xa39a90, linear.
  const [lamp, fill, above, below] = [0.9216, 0.8469, 1, 0.3231];

  it('is lamp, fill and what comes from all around, each over pi', () => {
    const towardsViewer = (2.5 * lamp * 1) / 1.4534 + (0.9 * fill * 0.8) / 1.2845 + (0.9 * (above + below)) / 2;
    expect(green(0, 0, 1)).toBeCloseTo(towardsViewer / Math.PI, 2);
    const up = (2.5 * lamp * 0.9) / 1.4534 + 0.9 * above;
    expect(green(0, 1, 0)).toBeCloseTo(up / Math.PI, 2);
    expect(green(0, -1, 0)).toBeCloseTo(((0.9 * fill * 0.1) / 1.2845 + 0.9 * below) / Math.PI, 2);
    expect(green(0, 0, -1)).toBeCloseTo((0.9 * (above + below)) / 2 / Math.PI, 2);
  });
});
