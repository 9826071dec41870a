import type { Signal } from '@preact/signals';

import { mayLeave } from './unsaved';

/** Which page is shown; the live page's own addresses (replays) are no concern of it. */
export type Route =
  | { kind: 'dashboard' }
  | { kind: 'live' }
  | { kind: 'trainee' }
  | { kind: 'sessions' }
  /** Deleted sessions. */
  | { kind: 'trash' }
  /** One session that has ended, or two beside each other. */
  | { kind: 'review'; id: string; beside: string | null }
  | { kind: 'cases' }
  | { kind: 'case'; id: string }
  | { kind: 'studies' }
  | { kind: 'study'; id: string }
  | { kind: 'questionnaire'; id: string; participant: string }
  /** The replays of a study that the user rates. */
  | { kind: 'rating'; id: string }
  | { kind: 'rubrics' }
  | { kind: 'rubric'; id: string }
  | { kind: 'benchmarks' }
  | { kind: 'users' }
  /** Who changed what. */
  | { kind: 'audit' }
  | { kind: 'account' };

const places = [
  'trainee',
  'sessions',
  'trash',
  'cases',
  'studies',
  'rubrics',
  'benchmarks',
  'users',
  'audit',
  'account',
] as const;
/** Every page that an address can name. */
export const routeKinds: readonly Route['kind'][] = [
  'dashboard',
  'live',
  'review',
  'case',
  'study',
  'questionnaire',
  'rating',
  'rubric',
  ...places,
];

export function routeInAddress(hash: string): Route {
  if (hash === '#/') return { kind: 'dashboard' };
  const [reviewed, reviewId = '', beside = null] =
    /^#\/review\/([0-9a-z]{4,32})(?:\/([0-9a-z]{4,32}))?\/?(?:\?.*)?$/.exec(hash) ?? [];
  if (reviewed !== undefined) return { kind: 'review', id: reviewId, beside };
  const [rating, ratedId = ''] = /^#\/studies\/([a-z0-9-]{1,64})\/rate\/?(?:\?.*)?$/.exec(hash) ?? [];
  if (rating !== undefined) return { kind: 'rating', id: ratedId };
  const [found, place = '', id, participant] =
    /^#\/([a-z]+)(?:\/([a-z0-9-]{1,64})(?:\/answers\/([2-9A-Z]{2}-[2-9A-Z]{3}))?)?\/?(?:\?.*)?$/.exec(hash) ?? [];
  if (found === undefined) return { kind: 'live' };
  const kind = places.find((known) => known === place);
  if (id === undefined) return kind === undefined ? { kind: 'live' } : { kind };
  if (place === 'studies')
    return participant === undefined ? { kind: 'study', id } : { kind: 'questionnaire', id, participant };
  if (participant !== undefined) return { kind: 'live' };
  return place === 'cases' ? { kind: 'case', id } : place === 'rubrics' ? { kind: 'rubric', id } : { kind: 'live' };
}

export function addressOfRoute(route: Route): string {
  switch (route.kind) {
    case 'dashboard':
      return '#/';
    case 'live':
      return '#';
    case 'review':
      return `#/review/${route.id}${route.beside === null ? '' : `/${route.beside}`}`;
    case 'case':
      return `#/cases/${route.id}`;
    case 'study':
      return `#/studies/${route.id}`;
    case 'questionnaire':
      return `#/studies/${route.id}/answers/${route.participant}`;
    case 'rating':
      return `#/studies/${route.id}/rate`;
    case 'rubric':
      return `#/rubrics/${route.id}`;
    case 'trainee':
    case 'sessions':
    case 'trash':
    case 'cases':
    case 'studies':
    case 'rubrics':
    case 'benchmarks':
    case 'users':
    case 'audit':
    case 'account':
      return `#/${route.kind}`;
  }
}

/** Whether the page shows the bone of a session. */
export const showsSession = (route: Route): boolean => route.kind === 'live' || route.kind === 'trainee';

/** Changes of the address change the page. */
export function followRoute(route: Signal<Route>): void {
  window.addEventListener('hashchange', () => {
    const next = routeInAddress(window.location.hash);
    const here = addressOfRoute(route.value);
    if (addressOfRoute(next) === here) return;
    if (mayLeave()) route.value = next;
    else window.history.replaceState(null, '', here);
  });
}
