import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { describe, expect, it } from 'vitest';

import { readPaper } from './papers';

/** Columns of trace.csv as the program writes them. */
function writtenColumns(): string[] {
  const source = readFileSync(join(__dirname, '../../../server/record/trace_columns.cpp'), 'utf8');
  return [...source.matchAll(/TraceColumn\{\s*"(\w+)"/g)].map(([, name]) => name ?? '');
}

describe('The codebook of trace.csv', () => {
  it('has the columns of the file, in its order', () => {
    const section = readPaper('docs/scripting.md').split('## Codebook of trace.csv')[1]?.split('\n## ')[0] ?? '';
    const cells = section.split('\n').map((line) => /^\| (`[^|]*) \|/.exec(line)?.[1] ?? '');
    const named = cells.flatMap((cell) => [...cell.matchAll(/`(\w+)`/g)].map(([, name]) => name ?? ''));
    expect(named).toEqual(writtenColumns());
    expect(named.length).toBeGreaterThan(40);
  });
});
