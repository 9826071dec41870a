// What was cut is told from what is whole at a glance, by every kind of colour vision.
import { Color } from 'three';
import { describe, expect, it } from 'vitest';

import { cutBoneColours, wholeBoneColour } from '../../src/scene/cut_bone';
import { lightInShadow } from '../../src/scene/lights';
import { poreColours } from '../../src/scene/pores';

type Rows = readonly [readonly number[], readonly number[], readonly number[]];
/** How colours are seen, linear RGB: Machado, Oliveira and Fernandes 2009, severity 1. */
const seenBy: Record<string, Rows> = {
  everybody: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protanopes: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deuteranopes: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritanopes: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};

function luminance(css: string, rows: Rows): number {
  const linear = new Color(css).toArray();
  const seen = rows.map((row) => row.reduce((sum, share, i) => sum + share * (linear[i] ?? 0), 0));
  const [red = 0, green = 0, blue = 0] = seen.map((value) => Math.min(Math.max(value, 0), 1));
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

describe.each(Object.entries(seenBy))('%s', (_, rows) => {
  it.each(Object.entries({ ...cutBoneColours, ...poreColours }))(
    'tell %s bone that was cut from bone that is whole',
    (_kind, cut) => {
      const contrast = (luminance(wholeBoneColour, rows) + 0.05) / (luminance(cut, rows) + 0.05);
      expect(contrast).toBeGreaterThanOrEqual(3);
    },
  );

  it.each(Object.entries({ ...cutBoneColours, ...poreColours }))(
    'tell lit %s bone that was cut from bone that is whole and lies in a shadow',
    (_kind, cut) => {
      const whole = lightInShadow * luminance(wholeBoneColour, rows);
      expect((whole + 0.05) / (luminance(cut, rows) + 0.05)).toBeGreaterThanOrEqual(3);
    },
  );

  it('tell the walls of spongy bone from its marrow', () => {
    const contrast = (luminance(poreColours.wall, rows) + 0.05) / (luminance(poreColours.marrow, rows) + 0.05);
    expect(contrast).toBeGreaterThanOrEqual(1.5);
  });
});
