import { describe, expect, it } from 'vitest';

import { isSaid, messageSources, quotedMessages } from './message_sources';
import { readPaper } from './papers';

describe('Troubleshooting', () => {
  const sources = messageSources();
  const messages = quotedMessages(readPaper('docs/troubleshooting.md')).filter(
    (message) => !message.startsWith('ream doctor'),
  );

  it('quotes many messages', () => expect(messages.length).toBeGreaterThan(50));

  it('quotes nothing that nobody says', () =>
    expect(messages.filter((message) => !isSaid(message, sources))).toEqual([]));

  it('reads literals as compilers do', () => {
    expect(isSaid('one … three', ['f("one two " +\n x + " three")'])).toBe(true);
    expect(isSaid('one four', ['f("one two")'])).toBe(false);
    expect(quotedMessages('| `a b` or `c …` | `no` |\n|---|---|\n')).toEqual(['a b', 'c …']);
  });
});
