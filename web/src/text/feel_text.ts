import type { FeelComparison, PlateName, SampleQuestion } from '../wire/rest_types';

/** Texts of blind studies of feel and of sample sizes; loaded with the pages of studies. */
export const feelText = {
  kind: 'Kind of study',
  kinds: [
    ['scores', 'Scores'],
    ['feel', 'Feel (blind)'],
  ] as const,
  about:
    'Each trial has two plates. The participant reams both without seeing the material, then answers a question. Participants do not learn whether the answer is right.',
  comparisons: 'Questions',
  comparisonNames: {
    cartilage: 'Which plate begins with cartilage?',
    bone_under_cartilage: 'On which plate does the reamer come to bone?',
    through_plate: 'On which plate does the reamer break through the hard layer?',
    density: 'Which plate is of denser bone?',
  } satisfies Record<FeelComparison, string>,
  trialsEach: 'Trials for each question',
  trials: (count: number, minutes: number) =>
    `${count} trials for each participant, about ${minutes} ${minutes === 1 ? 'minute' : 'minutes'}.`,
  fact: (trials: number) => `Feel (blind): ${trials} trials for each participant`,

  yourPart: 'Your part',
  run: 'Run trials',
  participant: 'Participant',
  loading: 'Loading…',
  trial: (number: number, of: number) => `Trial ${number} of ${of}`,
  toFeel:
    'There are two round plates, one above the other. Ream both as often as you like. Then end the session and answer here.',
  toAnswer: 'If you are not sure, choose the more likely plate. You cannot change the answer later.',
  feel: 'Feel the plates',
  feelAgain: 'Feel the plates again',
  starting: 'Starting…',
  answers: 'Your answer',
  plates: [
    ['upper', 'Upper'],
    ['lower', 'Lower'],
  ] as const satisfies readonly (readonly [PlateName, string])[],
  done: 'You have answered all trials. Thank you.',
  questionnaire: 'Answer the questionnaire',

  ended: 'The session has ended',
  endedHint: 'Answer the question now. If you have not touched both plates, feel them again first.',
  answerNow: 'Answer now',
  underWay: 'The session is still active',
  underWayHint: 'Resume the session, or end it and answer.',
  goOn: 'Resume session',
  end: 'End session',
  outside: 'Practise outside the study',

  report: 'Correct answers',
  reportHint: 'Guessing gives 50 %. Only participants who answered all trials of a question are counted.',
  reportClosed: 'Only operators see the report until the study is closed.',
  show: 'Show report',
  again: 'Update report',
  computing: 'Computing…',
  csv: 'Answers of all trials (CSV)',
  nobody: 'No answers yet.',
  answered: (participants: number) =>
    participants === 1 ? 'One participant has answered.' : `${participants} participants have answered.`,
  columns: {
    question: 'Question',
    participants: 'Participants',
    right: 'Correct (95 % interval)',
    sd: 'SD',
    p: 'p against chance (Holm)',
    dPrime: 'd′',
    published: 'Published',
    note: 'Note',
  },
  percent: (percent: string) => `${percent} %`,
  interval: (share: string, low: string, high: string) => `${share} % (${low} to ${high} %)`,
  published: (share: string, sd: string) => `${share} % (SD ${sd} %)`,

  sample: 'How many participants are needed?',
  sampleQuestion: 'Aim of the study',
  sampleQuestions: [
    ['means', 'Two groups differ in a number, such as points'],
    ['shares', 'Two groups differ in their success rate'],
    ['agreement', 'Raters agree well enough'],
    ['precision', 'The agreement of raters is known precisely'],
  ] as const satisfies readonly (readonly [SampleQuestion, string])[],
  sampleFields: {
    effect: 'Difference of the means, in standard deviations',
    first: 'Success rate in the first group, %',
    second: 'Success rate in the second group, %',
    raters: 'Raters for each session',
    expected: 'Expected agreement (ICC, 0 to 1)',
    least: 'Lowest acceptable agreement (ICC, 0 to 1)',
    width: 'Width of the 95 % interval of the ICC',
    power: 'Power: chance to find a real effect, %',
  },
  perGroup: (needed: number) => `${needed} ${needed === 1 ? 'person' : 'people'} in each of two groups.`,
  perSession: (needed: number, raters: number) =>
    `${needed} ${needed === 1 ? 'session' : 'sessions'}, each rated by ${raters} raters.`,
  source: (source: string) => `Source: ${source}`,
};
