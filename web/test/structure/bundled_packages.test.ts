import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { describe, expect, it } from 'vitest';

import { bundledPackages, packageFolderOf, packageOf } from '../../scripts/bundled_packages';

const web = resolve(__dirname, '../..');
const modules = (name: string) => resolve(web, 'node_modules', name);
const own = JSON.parse(readFileSync(resolve(web, 'package.json'), 'utf8')) as { dependencies: Record<string, string> };

describe('packages in the page', () => {
  it('are found from their modules', () => {
    expect(packageFolderOf(`${modules('three')}/build/three.module.js?worker`)).toBe(modules('three'));
    expect(packageFolderOf(`\0${modules('@preact/signals')}/dist/signals.mjs`)).toBe(modules('@preact/signals'));
    expect(packageFolderOf(`${web}/src/main.tsx`)).toBeNull();
  });

  it('have a licence each, with its text', () => {
    for (const [name, version] of Object.entries(own.dependencies)) {
      const found = packageOf(modules(name));
      expect([found.name, found.version]).toEqual([name, version]);
      expect(found.text.length, name).toBeGreaterThan(500);
    }
    expect(() => packageOf(resolve(web, 'test'))).toThrow();
  });

  it('are written with the page, those of its workers, too', () => {
    const plugins = bundledPackages();
    const written = new Map<string, string>();
    const emitFile = ({ fileName, source }: { fileName: string; source: string }) => written.set(fileName, source);
    const run = (of: { generateBundle?: unknown }[], names: string[]) => {
      const bundle = Object.fromEntries(
        names.map((name) => [name, { type: 'chunk', modules: { [`${modules(name)}/index.js`]: {} } }]),
      );
      for (const plugin of of)
        (plugin.generateBundle as (this: unknown, options: unknown, bundle: unknown) => void).call(
          { emitFile },
          {},
          bundle,
        );
    };
    run(plugins.worker(), ['flatbuffers']);
    run(plugins.page, ['three', 'three-mesh-bvh']);
    const about = JSON.parse(written.get('third-party.json') ?? '') as { name: string; license: string }[];
    expect(about.map(({ name }) => name)).toEqual(['flatbuffers', 'three', 'three-mesh-bvh']);
    expect(written.get('third-party.txt')).toContain('Apache License');
  });
});
