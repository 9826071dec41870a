import { describe, expect, it } from 'vitest';

import { headsetMessage } from '../../src/scene/headset_text';
import { Store } from '../../src/state/store';
import { hello, telemetry } from '../wire/fake_messages';
import { someAnnotation } from '../wire/some_answers';

function watching(): Store {
  const store = new Store();
  const first = hello({ plannedDepthMm: 2.5 });
  if (first.kind === 'hello') store.hello.value = first.hello;
  const news = telemetry({ tick: 1000, depthMm: 1.25, thrustN: Float32Array.of(3, 31.6) });
  if (news.kind === 'telemetry') store.telemetry.value = news.telemetry;
  store.link.value = { kind: 'live' };
  store.pictureComplete.value = true;
  return store;
}

describe('what the wearer of a headset reads', () => {
  it('is thrust and depth of what is live', () => {
    expect(headsetMessage(watching())).toEqual({ text: 'Live   32 N   1.3 of 2.5 mm', warns: false });
  });

  it('says of a recording that it is one, and where it stands', () => {
    const store = watching();
    store.replayId.value = 'r1';
    store.playback.value = { positionTicks: 12_300, speed: 1, playing: true, jump: 0 };
    expect(headsetMessage(store)).toEqual({ text: 'Recording 0:12.3   32 N   1.3 of 2.5 mm', warns: false });
  });

  it('warns and tells no figure as soon as what is seen is not of this moment', () => {
    const store = watching();
    store.link.value = { kind: 'silent', sinceMs: 0 };
    expect(headsetMessage(store).warns).toBe(true);
    expect(headsetMessage(store).text).not.toMatch(/\d/);
    expect(headsetMessage(new Store()).warns).toBe(true);
  });

  it('is a comment for a while, cut to a line, but never in place of a warning', () => {
    const comment = { ...someAnnotation(1, 'Tilt less'), author: 'Ines' };
    expect(headsetMessage(watching(), comment)).toEqual({ text: 'Ines: Tilt less', warns: false });
    const { text } = headsetMessage(watching(), { ...comment, words: 'less '.repeat(40) });
    expect(text).toMatch(/^Ines: .*…$/);
    expect(text.length).toBeLessThanOrEqual(60);
    expect(headsetMessage(new Store(), comment).warns).toBe(true);
  });
});
