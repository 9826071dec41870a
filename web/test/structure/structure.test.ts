import { describe, expect, it } from 'vitest';

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
