import { signal } from '@preact/signals';
import { describe, expect, it } from 'vitest';

import { followTitle, shownName, titleOf } from '../../src/state/page_title';
import { type Route, routeKinds } from '../../src/state/route';
import { pageTitles } from '../../src/text/title_text';

describe('titles of pages', () => {
  it('has one for every page of the router, and no other', () => {
    expect(Object.keys(pageTitles).sort()).toEqual([...routeKinds].sort());
  });

  it('tells pages apart, and what they show', () => {
    const titles = routeKinds.map((kind) => titleOf(kind, ''));
    expect(new Set(titles).size).toBe(routeKinds.length);
    expect(titleOf('cases', '')).toBe('Cases – ream');
    expect(titleOf('review', 'First attempt')).toBe('Review: First attempt – ream');
    expect(titleOf('users', 'nobody')).toBe('Users – ream');
  });

  it('follows the page', () => {
    const tab = { title: '' };
    const route = signal<Route>({ kind: 'cases' });
    const out = signal(true);
    const end = followTitle({ route, loggedOut: () => out.value }, tab);
    expect(tab.title).toBe('Log in – ream');
    out.value = false;
    expect(tab.title).toBe('Cases – ream');
    shownName.value = 'Demo';
    route.value = { kind: 'case', id: 'demo' };
    expect(tab.title).toBe('Case: Demo – ream');
    shownName.value = '';
    end();
  });
});
