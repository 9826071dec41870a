import { describe, expect, it } from 'vitest';

import { sessionChoices } from '../../src/state/session_choices';
import { appText } from '../../src/text/app_text';
import { liveText } from '../../src/text/live_text';

describe('what can be done with a session', () => {
  it('is to pause it in one place only', () => {
    expect(sessionChoices({ state: 'running', held: false, steered: false }).pause).toBe('pause');
    expect(sessionChoices({ state: 'running', held: false, steered: true }).pause).toBeNull();
    // The hand rests by its own button, and goes on by it.
    expect(sessionChoices({ state: 'paused', held: false, steered: true }).pause).toBeNull();
    // Who was paused by an instructor finds the way on.
    expect(sessionChoices({ state: 'paused', held: true, steered: true }).pause).toBe('resume');
    expect(sessionChoices({ state: 'paused', held: true, steered: false }).pause).toBe('resume');
  });

  it('is to start it again only while it is under way', () => {
    for (const state of ['running', 'paused'] as const)
      expect(sessionChoices({ state, held: false, steered: true }).startAgain, state).toBe(true);
    for (const state of ['created', 'finished', 'stopped', 'fault', 'interrupted', 'replaying', null] as const)
      expect(sessionChoices({ state, held: true, steered: false }), String(state)).toEqual({
        pause: null,
        startAgain: false,
      });
  });

  it('is named by what a press does', () => {
    expect([appText.spindleButton(false), appText.spindleButton(true)]).toEqual(['Start spindle', 'Stop spindle']);
    expect([liveText.soundButton(false), liveText.soundButton(true)]).toEqual(['Turn sound on', 'Turn sound off']);
  });
});
