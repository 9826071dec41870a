import type { Signal } from '@preact/signals';

/** Which page is shown; the live page's own addresses (replays) are no concern of it. */
export type Route = { kind: 'live' } | { kind: 'cases' } | { kind: 'case'; id: string };

export function routeInAddress(hash: string): Route {
  const [found, id] = /^#\/cases(?:\/([a-z0-9-]{1,64}))?\/?$/.exec(hash) ?? [];
  if (found === undefined) return { kind: 'live' };
  return id === undefined ? { kind: 'cases' } : { kind: 'case', id };
}

export function addressOfRoute(route: Route): string {
  return route.kind === 'live' ? '#' : route.kind === 'cases' ? '#/cases' : `#/cases/${route.id}`;
}

/** Changes of the address change the page. */
export function followRoute(route: Signal<Route>): void {
  window.addEventListener('hashchange', () => {
    const next = routeInAddress(window.location.hash);
    if (addressOfRoute(next) !== addressOfRoute(route.value)) route.value = next;
  });
}
