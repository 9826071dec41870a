import { effect, signal, type ReadonlySignal } from '@preact/signals';

import { logInTitle, type PageTitle, pageTitles, withProduct } from '../text/title_text';
import type { Route } from './route';

/** The name of what the page shows, where it has one: a session's title, a case, a study; set by that page. */
export const shownName = signal('');

/** What the browser's tab and history say of a page. */
export function titleOf(kind: Route['kind'], name: string): string {
  const { page, of }: PageTitle = pageTitles[kind];
  return withProduct(name === '' || of === undefined ? page : of(name));
}

/** Keeps the document's title that of the page. */
export function followTitle(
  { route, loggedOut }: { route: ReadonlySignal<Route>; loggedOut: () => boolean },
  document: { title: string },
): () => void {
  return effect(() => {
    document.title = loggedOut() ? withProduct(logInTitle) : titleOf(route.value.kind, shownName.value);
  });
}
