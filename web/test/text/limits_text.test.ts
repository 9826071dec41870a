import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';

import { limits, limitsTitle } from '../../src/text/limits_text';

describe('what the simulator does not know', () => {
  it('stands in README.md in the same words', () => {
    const readme = readFileSync(new URL('../../../README.md', import.meta.url), 'utf8').replace(/\s+/g, ' ');
    expect(readme).toContain(`## ${limitsTitle}`);
    for (const limit of limits) expect(readme).toContain(`- ${limit}`);
  });
});
