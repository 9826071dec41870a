import { readdirSync, readFileSync } from 'node:fs';

import { describe, expect, it } from 'vitest';

import { appText, markKinds } from '../../src/text/app_text';

const live = new URL('../../../server/session/live/', import.meta.url);
const read = (file: string) => readFileSync(new URL(file, live), 'utf8');

/** In quotes in the words about what SessionEvents finds. */
const listed = () => {
  const comment = /Those of this tick, with their kinds:([\s\S]*?)std::vector/.exec(read('session_events.hpp'))?.[1];
  return [...(comment ?? '').matchAll(/"([a-z_]+)"/g)].map(([, kind]) => kind ?? '');
};

/** Of every event that a session writes into its recording. */
const written = () =>
  readdirSync(live)
    .filter((file) => file.endsWith('.cpp'))
    .flatMap((file) => [...read(file).matchAll(/(?:ops::Event|push_back\(?)\s*\{[^"{}]*?,\s*"([a-z_]+)"/g)])
    .map(([, kind]) => kind ?? '');

describe('the names of events', () => {
  it('are there for every kind that a session records', () => {
    expect(listed().length).toBeGreaterThanOrEqual(6);
    expect(written()).toEqual(expect.arrayContaining([...listed(), 'failover']));
    // Those that end a session with words are named by its state.
    const kinds = new Set([
      ...listed(),
      ...written(),
      'fault',
      'interrupted',
      'annotation',
      'reamer',
      'resume',
      'damaged',
    ]);
    expect([...kinds].filter((kind) => !(kind in markKinds))).toEqual([]);
  });

  it('have no program words, also where the page is older than the server', () => {
    for (const kind of [...Object.keys(markKinds), 'coolant_low'])
      expect(appText.mark(kind)).toMatch(/^[A-Z][A-Za-z0-9 ]+$/);
  });
});
