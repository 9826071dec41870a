/** What the browser's tab says of each page; `of` takes the name of what the page shows. */
export interface PageTitle {
  page: string;
  of?: (name: string) => string;
}

export const pageTitles = {
  dashboard: { page: 'Overview' },
  live: { page: 'Live' },
  trainee: { page: 'Trainee view' },
  sessions: { page: 'Sessions' },
  trash: { page: 'Deleted sessions' },
  review: { page: 'Review', of: (name) => `Review: ${name}` },
  cases: { page: 'Cases' },
  case: { page: 'Case', of: (name) => `Case: ${name}` },
  studies: { page: 'Studies' },
  study: { page: 'Study', of: (name) => `Study: ${name}` },
  questionnaire: { page: 'Questionnaire' },
  rating: { page: 'Rating' },
  rubrics: { page: 'Rubrics' },
  rubric: { page: 'Rubric', of: (name) => `Rubric: ${name}` },
  benchmarks: { page: 'Benchmarks' },
  users: { page: 'Users' },
  audit: { page: 'Audit log' },
  account: { page: 'Account' },
} satisfies Record<string, PageTitle>;

export const logInTitle = 'Log in';
export const withProduct = (page: string) => `${page} – ream`;
