/** Texts of the result card, and the words for the outcome of a session on every page. */
import type { Outcome } from '../wire/rest_types';

export const outcomeText: Readonly<Record<NonNullable<Outcome> | 'none', string>> = {
  pass: 'Passed',
  fail: 'Failed',
  undecided: 'Not assessed',
  none: 'Not scored',
};

export const resultText = {
  title: 'Session ended',
  scoring: 'The score is being computed…',
  points: 'of 100 points',
  passMark: (points: string) => `Pass mark: ${points} points`,
  noPoints: 'No points',
  noBone: 'No bone was removed.',
  noScore: (reason: string) => `There is no score yet. ${reason}`,
  nextTime: 'Next time',
  figures: 'Measured',
  meanThrust: 'Mean thrust',
  peakThrust: 'Peak thrust',
  cortical: 'Cortical bone',
  cancellous: 'Cancellous bone',
  startAgain: 'Start again',
  startAgainHint: 'A new session on the same case, at the same level',
  practiseHint: 'A new session on this case, at the level that you chose',
  report: 'Report (PDF)',
  making: (percent: string) => `Report: ${percent}`,
  reportFailed: (reason: string) => `The report could not be prepared. ${reason}`,
  close: 'Close the result',
  show: 'Show result',
};
