import { describe, expect, it } from 'vitest';

import { watchContext } from '../../src/scene/context_watch';

describe('watchContext', () => {
  it('knows that the picture is lost, asks for it back, and has it drawn anew', () => {
    const canvas = new EventTarget();
    let restored = 0;
    const watch = watchContext(canvas, () => ++restored);
    const loss = new Event('webglcontextlost', { cancelable: true });
    canvas.dispatchEvent(loss);
    expect([watch.lost.value, loss.defaultPrevented, restored]).toEqual([true, true, 0]);
    canvas.dispatchEvent(new Event('webglcontextrestored'));
    expect([watch.lost.value, restored]).toEqual([false, 1]);
  });

  it('heeds a canvas no more that is done with', () => {
    const canvas = new EventTarget();
    const watch = watchContext(canvas, () => undefined);
    watch.dispose();
    canvas.dispatchEvent(new Event('webglcontextlost'));
    expect(watch.lost.value).toBe(false);
  });
});
