import { describe, expect, it } from 'vitest';

import { toolAction } from '../../src/state/tool_action';
import type { SessionState, Telemetry } from '../../src/wire/telemetry';
import { telemetry } from '../wire/fake_messages';

function sample(changes: Partial<Telemetry>): Telemetry {
  const message = telemetry(changes);
  if (message.kind !== 'telemetry') throw new Error('no telemetry');
  return message.telemetry;
}
const playback = (speed: number, playing = true) => ({ positionTicks: 5, speed, playing, jump: 0 });

describe('toolAction', () => {
  it('is what the reamer does while its session runs', () => {
    const told = sample({ spindleSpeedRadS: 12, irrigating: true, removedVolumeMm3: 7, tick: 300 });
    expect(toolAction(told, true)).toEqual({ spindleRadS: 12, irrigating: true, removedMm3: 7, tick: 300 });
    expect(toolAction(sample({ spindleSpeedRadS: -12 }), true)?.spindleRadS).toBe(-12);
    expect(toolAction(sample({ spindleSpeedRadS: 0.1 }), true)?.spindleRadS).toBe(0);
  });

  it('is nothing where nothing is known or all rests', () => {
    expect(toolAction(null, true)).toBeNull();
    expect(toolAction(sample({}), false)).toBeNull();
    const resting: SessionState[] = ['created', 'paused', 'finished', 'stopped', 'fault', 'interrupted'];
    for (const state of resting) expect(toolAction(sample({ state }), true)).toBeNull();
    expect(toolAction(sample({ state: 'replaying', playback: playback(1, false) }), true)).toBeNull();
  });

  it('is as fast as a recording plays, also backwards', () => {
    const at = (speed: number) => toolAction(sample({ state: 'replaying', playback: playback(speed) }), true);
    expect(at(0.1)?.spindleRadS).toBeCloseTo(1.63);
    expect(at(-2)?.spindleRadS).toBeCloseTo(-32.6);
  });
});
