/** Texts about the choice of case and level, comments during a session, and the line about its study. */
import type { LevelName } from '../practice/level';

export const practiceText = {
  chooser: 'What to practise',
  case: 'Case',
  level: 'Level',
  levels: {
    guided: 'Guided',
    free: 'Free start',
    own: 'Free force',
    exam: 'Exam',
  } satisfies Record<LevelName, string>,
  levelHint: {
    guided: 'The reamer starts on the plan. You set the maximum force. Gauges and help are shown.',
    free: 'The reamer starts off the plan and tilted. You set the maximum force. Gauges and help are shown.',
    own: 'Like Free start, but the force rises while you push. Gauges are shown, help and alarms are not.',
    exam: 'Theatre mode: no gauges, plan or help. The reamer starts off the plan. The force rises while you push.',
  } satisfies Record<LevelName, string>,
  reamer: (name: string) => `Reamer: ${name}`,
  reamerOf: (name: string, diameter: string) => `${name}, ⌀ ${diameter} mm`,
  reamerHint: 'The reamer of this case’s plan',

  comments: 'New comments',
  comment: 'Comment:',
  commentBy: (author: string) => `${author}:`,
  dismissComment: 'Dismiss comment',

  study: 'In a study',
  studyNamed: (name: string) => `Study ${name}`,
  attempt: (number: number) => `attempt ${number}`,

  demoRun: 'Demo',
  scriptRun: 'Script',
};
