import { describe, expect, it } from 'vitest';

import { isPageLost, sessionChoices } from '../../src/state/session_choices';
import { appText } from '../../src/text/app_text';
import { liveText } from '../../src/text/live_text';
import { resultText } from '../../src/text/result_text';
import { tutorialText } from '../../src/text/tutorial_text';
import type { Session } from '../../src/wire/rest_types';

describe('what can be done with a session', () => {
  it('is to pause it in one place only', () => {
    expect(sessionChoices({ state: 'running', held: false, steered: false, pageLost: false }).pause).toBe('pause');
    expect(sessionChoices({ state: 'running', held: false, steered: true, pageLost: false }).pause).toBeNull();
    // The hand rests by its own button, and goes on by it.
    expect(sessionChoices({ state: 'paused', held: false, steered: true, pageLost: false }).pause).toBeNull();
    // Who was paused by an instructor finds the way on.
    expect(sessionChoices({ state: 'paused', held: true, steered: true, pageLost: false }).pause).toBe('resume');
    expect(sessionChoices({ state: 'paused', held: true, steered: false, pageLost: false }).pause).toBe('resume');
  });

  it('is to start it again only while it is under way', () => {
    for (const state of ['running', 'paused'] as const)
      expect(sessionChoices({ state, held: false, steered: true, pageLost: false }).startAgain, state).toBe(true);
    for (const state of ['created', 'finished', 'stopped', 'fault', 'interrupted', 'replaying', null] as const)
      expect(sessionChoices({ state, held: true, steered: false, pageLost: false }), String(state)).toEqual({
        pause: null,
        startAgain: false,
        left: false,
      });
  });

  it('is to continue or to end one whose page has gone', () => {
    const left = { state: 'paused', held: false, steered: false, pageLost: true } as const;
    expect(sessionChoices(left)).toEqual({ pause: null, startAgain: false, left: true });
    // Its own page pauses it and is there; it runs on; an instructor holds it; it is back in this hand.
    for (const other of [{ pageLost: false }, { state: 'running' }, { held: true }, { steered: true }] as const)
      expect(sessionChoices({ ...left, ...other }).left, JSON.stringify(other)).toBe(false);
    expect(isPageLost({ device: { name: 'browser', state: 'lost' } as Session['device'] })).toBe(true);
    expect(isPageLost({ device: { name: 'haply', state: 'lost' } as Session['device'] })).toBe(false);
    expect(isPageLost({ device: { name: 'browser', state: 'fresh' } as Session['device'] })).toBe(false);
  });

  it('is named alike wherever a new session on intact bone begins', () => {
    expect([appText.resetSession, appText.resetYes, resultText.startAgain, tutorialText.again]).toEqual(
      Array<string>(4).fill('Start again'),
    );
  });

  it('is named by what a press does', () => {
    expect([appText.spindleButton(false), appText.spindleButton(true)]).toEqual(['Start spindle', 'Stop spindle']);
    expect([liveText.soundButton(false), liveText.soundButton(true)]).toEqual(['Turn sound on', 'Turn sound off']);
  });
});
