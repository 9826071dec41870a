import { describe, expect, it } from 'vitest';

import { functionLengths, percentile } from './function_length';
import { betweenFolders, findCycle, importsOf, parse, readSources } from './source_graph';

const sources = readSources();
const imports = importsOf(sources);

describe('Imports of the page', () => {
  it('are found', () => {
    expect(imports.get('main.tsx')).toContain('pages/app.tsx');
    expect(imports.get('pages/app.tsx')).toContain('pages/case_pages.tsx');
    expect(imports.get('wire/stream_socket.ts')).toContain('wire/stream_worker.ts');
  });

  it('form no cycle of files', () => expect(findCycle(imports)).toBeNull());
  it('form no cycle of folders', () => expect(findCycle(betweenFolders(imports))).toBeNull());

  it('would be found in a cycle', () => {
    const looped = importsOf(
      new Map([
        ['a/one.ts', parse('a/one.ts', "import type { Two } from '../b/two';")],
        ['b/two.ts', parse('b/two.ts', "export { three } from './three';")],
        ['b/three.ts', parse('b/three.ts', "export const three = () => import('../a/one');")],
      ]),
    );
    expect(findCycle(looped)).toEqual(['a/one.ts', 'b/two.ts', 'b/three.ts', 'a/one.ts']);
    expect(findCycle(betweenFolders(looped))).toEqual(['a', 'b', 'a']);
  });
});

describe('Functions of the page', () => {
  const lengths = functionLengths(sources);

  it('are found, components and methods too', () => {
    const names = lengths.map(({ name }) => name);
    expect(names).toContain('pages/app.tsx: App');
    expect(names).toContain('state/watcher.ts: watch');
    expect(names).toContain('panels/picture/trace_plot.tsx: redraw');
  });

  it('are short', () => {
    expect(lengths.filter(({ lines }) => lines > 80)).toEqual([]);
    expect(percentile(lengths, 0.9)).toBeLessThanOrEqual(25);
  });

  it('are counted by their lines', () => {
    const source = parse('a.ts', 'export function two(): void {\n}\nconst one = () => 1;');
    const counted = [
      { name: 'a.ts: two', lines: 2 },
      { name: 'a.ts: one', lines: 1 },
    ];
    expect(functionLengths(new Map([['a.ts', source]]))).toEqual(counted);
  });
});
