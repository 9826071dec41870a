import type { FeelComparison, PlateName, SampleQuestion } from '../wire/rest_types';

/** Texts of blind studies of feel and of sample sizes; loaded with the pages of studies. */
export const feelText = {
  kind: 'Kind of study',
  kinds: [
    ['scores', 'Scores'],
    ['feel', 'Feel (blind)'],
  ] as const,
  about:
    'Each trial has two plates. The participant reams both without seeing what they are made of, then answers a question. Nobody says whether the answer is right.',
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
    'Two round plates lie one above the other. Ream both, as often as you like. Then end the session and answer here.',
  toAnswer: 'If you are not sure, choose the plate that is more likely. You cannot change the answer later.',
  feel: 'Feel the plates',
  feelAgain: 'Feel them again',
  starting: 'Starting…',
  answers: 'Your answer',
  plates: [
    ['upper', 'Upper'],
    ['lower', 'Lower'],
  ] as const satisfies readonly (readonly [PlateName, string])[],
  done: 'All trials are answered. Thank you.',
  questionnaire: 'Answer the questionnaire',

  ended: 'The session has ended',
  endedHint: 'Answer the question now. If you have not touched both plates, you can feel them again first.',
  answerNow: 'Answer now',
  underWay: 'The session has not ended',
  underWayHint: 'Take the reamer again, or end the session and answer.',
  goOn: 'Take the reamer',
  end: 'End session',
  outside: 'Practise outside the study',

  report: 'How often were participants right?',
  reportHint: 'Chance is 50 %. Numbers are of participants who have answered all trials of a question.',
  reportClosed: 'The report is for operators until the study is closed.',
  show: 'Show the report',
  again: 'Compute it again',
  computing: 'Computing…',
  csv: 'Answers of all trials (CSV)',
  nobody: 'No answers yet.',
  answered: (participants: number) =>
    participants === 1 ? 'One participant has answered.' : `${participants} participants have answered.`,
  columns: {
    question: 'Question',
    participants: 'Participants',
    right: 'Right (95 % interval)',
    sd: 'SD',
    p: 'p against chance (Holm)',
    dPrime: 'd′',
    published: 'Published',
    note: 'Remark',
  },
  percent: (percent: string) => `${percent} %`,
  interval: (share: string, low: string, high: string) => `${share} % (${low} to ${high} %)`,
  published: (share: string, sd: string) => `${share} % (SD ${sd} %)`,

  sample: 'How many participants are needed?',
  sampleQuestion: 'What is to be shown',
  sampleQuestions: [
    ['means', 'Two groups differ in a number, such as points'],
    ['shares', 'Two groups differ in how many succeed'],
    ['agreement', 'Raters agree well enough'],
    ['precision', 'How well raters agree, within a narrow interval'],
  ] as const satisfies readonly (readonly [SampleQuestion, string])[],
  sampleFields: {
    effect: 'Difference of the means, in standard deviations',
    first: 'How many succeed in the first group, %',
    second: 'How many succeed in the second group, %',
    raters: 'Raters of each session',
    expected: 'Agreement that you expect (ICC, 0 to 1)',
    least: 'Agreement that is too low (ICC, 0 to 1)',
    width: 'Width of the 95 % interval of the ICC',
    power: 'Chance to find it if it is there, %',
  },
  perGroup: (needed: number) => `${needed} ${needed === 1 ? 'person' : 'persons'} in each of two groups.`,
  perSession: (needed: number, raters: number) =>
    `${needed} ${needed === 1 ? 'session' : 'sessions'}, each rated by ${raters} raters.`,
  source: (source: string) => `Source: ${source}`,
};
