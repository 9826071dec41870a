import { describe, expect, it } from 'vitest';

import { levelNames, levelOf, levels } from '../../src/practice/level';
import { randomOf, startPose } from '../../src/practice/start_pose';

const far = ({ superior, anterior }: { superior: number; anterior: number }) => Math.hypot(superior, anterior);

describe('Levels', () => {
  it('take away one thing after the other', () => {
    const given = levelNames.map((name) => {
      const { startsOff, ownPressure, hints, theatre } = levels[name];
      return [startsOff === null, !ownPressure, hints, !theatre].filter(Boolean).length;
    });
    expect(given).toEqual([4, 3, 1, 0]);
    const starts = levelNames.map((name) => levels[name].startsOff?.placeMm.most ?? 0);
    expect(starts).toEqual([...starts].sort((a, b) => a - b));
  });

  it('are what the session says, else what the page remembers', () => {
    expect(levelOf({ theatre: true }, 'free')).toBe('exam');
    expect(levelOf({ theatre: false }, 'own')).toBe('own');
    expect(levelOf({ theatre: false }, 'exam')).toBe('guided');
    expect(levelOf({ theatre: false }, null)).toBe('guided');
    expect(levelOf(null, null)).toBe('guided');
  });
});

describe('The pose at the start', () => {
  it.each(levelNames)('at the level %s is within its limits, in every direction', (name) => {
    const { startsOff } = levels[name];
    const poses = Array.from({ length: 400 }, (_, i) => startPose(levels[name], randomOf(`session ${i}`)));
    if (startsOff === null) return expect(poses.every((pose) => pose === null)).toBe(true);
    const sides = new Set<string>();
    for (const pose of poses) {
      if (pose === null) throw new Error('no pose');
      expect(far(pose.place)).toBeGreaterThanOrEqual(startsOff.placeMm.least - 1e-9);
      expect(far(pose.place)).toBeLessThanOrEqual(startsOff.placeMm.most + 1e-9);
      expect(far(pose.lean)).toBeGreaterThanOrEqual(startsOff.tiltDeg.least - 1e-9);
      expect(far(pose.lean)).toBeLessThanOrEqual(startsOff.tiltDeg.most + 1e-9);
      sides.add(`${Math.sign(pose.place.superior)} ${Math.sign(pose.place.anterior)}`);
    }
    expect(sides.size).toBe(4);
  });

  it('is the same for the same session, and another for another one', () => {
    const of = (id: string) => startPose(levels.exam, randomOf(id));
    expect(of('abcd')).toEqual(of('abcd'));
    expect(of('abcd')).not.toEqual(of('abce'));
  });

  it('is spread evenly', () => {
    const random = randomOf('even');
    const drawn = Array.from({ length: 4000 }, random);
    const mean = drawn.reduce((sum, value) => sum + value, 0) / drawn.length;
    expect(mean).toBeCloseTo(0.5, 1);
    expect(Math.min(...drawn)).toBeGreaterThanOrEqual(0);
    expect(Math.max(...drawn)).toBeLessThan(1);
  });
});
