import { describe, expect, it } from 'vitest';

import { labelsOf } from '../../src/panels/live/session_labels';
import { someDevice, someSession } from '../wire/some_answers';

const byHand = { device: someDevice('browser'), script: 'practice' };

describe('Labels of the live session', () => {
  it('name who reams by hand', () => {
    expect(labelsOf(someSession({ ...byHand, trainee: 'Tom', title: 'First', attempt: 2 }))).toEqual([
      '“First”',
      'by Tom',
      'attempt 2',
    ]);
    expect(labelsOf(someSession(byHand))).toEqual([]);
  });

  it('name nobody where a script reams', () => {
    expect(labelsOf(someSession({ trainee: 'Tom' }))).toEqual(['Demo']);
    expect(labelsOf(someSession({ trainee: 'Tom', script: 'tilted' }))).toEqual(['Script']);
  });

  it('leave to the line of the study what it says', () => {
    expect(labelsOf(someSession({ ...byHand, study: 'st1', participant: 'P03', attempt: 2 }))).toEqual([]);
  });
});
