import { describe, expect, it } from 'vitest';

import { LastInput } from '../../src/practice/last_input';
import { FakeSurface } from './fake_surface';

describe('LastInput', () => {
  const listening = (coarse = false) => {
    const surface = new FakeSurface();
    const input = new LastInput();
    input.listen(surface as never, coarse);
    return { surface, input };
  };

  it('knows what was used last', () => {
    const { surface, input } = listening();
    expect(input.kind.value).toBe('mouse');
    surface.fire('keydown', { key: 's' });
    expect(input.kind.value).toBe('keys');
    surface.fire('pointerdown', { pointerType: 'touch' });
    expect(input.kind.value).toBe('touch');
    surface.fire('pointerdown', { pointerType: 'mouse' });
    expect(input.kind.value).toBe('mouse');
    input.take('gamepad');
    expect(input.kind.value).toBe('gamepad');
    surface.fire('wheel', {});
    expect(input.kind.value).toBe('mouse');
  });

  it('expects a finger where what points is coarse', () => {
    expect(listening(true).input.kind.value).toBe('touch');
  });

  it('takes neither a knock against the mouse nor what is held with it for a change of hands', () => {
    const { surface, input } = listening();
    surface.fire('keydown', { key: 's' });
    surface.fire('pointermove', { movementX: 5, movementY: -5 });
    expect(input.kind.value).toBe('keys');
    surface.fire('pointermove', { movementX: 20, movementY: 0 });
    expect(input.kind.value).toBe('mouse');
    surface.fire('keydown', { key: 'Control' });
    surface.fire('keydown', { key: 'a', repeat: true });
    expect(input.kind.value).toBe('mouse');
  });
});
