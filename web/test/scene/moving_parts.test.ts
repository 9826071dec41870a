import { describe, expect, it } from 'vitest';

import { MovingParts } from '../../src/scene/moving_parts';
import type { Pose } from '../../src/wire/messages';

const at = (x: number): Pose => ({ rotationXyzw: [0, 0, 0, 1], translationMm: [x, 2, 3] });
const action = (removedMm3: number, tick: number) => ({ spindleRadS: 16, irrigating: false, removedMm3, tick });

describe('MovingParts', () => {
  it('finds nothing new in the message of a session that is paused', () => {
    const parts = new MovingParts();
    const changes = (x: number, removedMm3: number, tick: number) => [
      parts.toolMoved(at(x)),
      parts.boneMoved(null),
      parts.actionChanged(action(removedMm3, tick)),
      parts.touchingChanged(false),
    ];
    expect(changes(1, 0, 1)).toEqual([true, true, true, true]);
    expect(changes(1, 0, 2)).toEqual([false, false, false, false]);
    expect(changes(1.0001, 0, 3)).toEqual([true, false, false, false]);
    expect(changes(1.0001, 5, 4)).toEqual([false, false, true, false]);
  });

  it('tells a part that comes or goes', () => {
    const parts = new MovingParts();
    parts.toolMoved(null);
    expect(parts.toolMoved(at(1))).toBe(true);
    expect(parts.toolMoved(null)).toBe(true);
    expect(parts.toolMoved(null)).toBe(false);
    parts.actionChanged(action(0, 1));
    expect(parts.actionChanged(null)).toBe(true);
  });

  it('forgets what was drawn with another reamer', () => {
    const parts = new MovingParts();
    parts.toolMoved(at(1));
    parts.forget();
    expect(parts.toolMoved(at(1))).toBe(true);
  });
});
