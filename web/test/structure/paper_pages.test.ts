// Papers as pages: every link and picture is there, and nothing in them breaks the server's rules for pages.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { paperNames, repository } from './papers';

const parent = mkdtempSync(join(tmpdir(), 'ream-pages-'));
const folder = join(parent, 'docs');
const read = (name: string) => readFileSync(join(folder, name), 'utf8');
const pages = () => readdirSync(folder).filter((name) => name.endsWith('.html'));
const all = (text: string, pattern: RegExp) => [...text.matchAll(pattern)].map(([, found = '']) => found);

function deadLinksOf(name: string): string[] {
  return all(read(name), /(?:href|src)="([^"]+)"/g).filter((target) => {
    if (/^[a-z]+:/.test(target) || target === '../') return false;
    const [file = '', anchor] = target.split('#');
    const other = file === '' ? name : file;
    if (!existsSync(join(folder, other))) return true;
    return anchor !== undefined && !read(other).includes(`id="${anchor}"`);
  });
}

describe('Pages of papers', () => {
  beforeAll(() => {
    const { status, stderr } = spawnSync('node', ['web/scripts/papers.mjs', folder], {
      cwd: repository,
      encoding: 'utf8',
    });
    expect(status, stderr).toBe(0);
  });
  afterAll(() => rmSync(parent, { recursive: true, force: true }));

  it('are there for all papers of docs', () =>
    expect(pages()).toEqual(
      expect.arrayContaining(
        paperNames()
          .filter((name) => name.startsWith('docs/'))
          .map((name) => name.replace('docs/', '').replace('.md', '.html')),
      ),
    ));

  it('lead nowhere that is not there', () => expect(pages().flatMap(deadLinksOf)).toEqual([]));

  it('need no script, and no style of their own', () =>
    expect(pages().filter((name) => /<script|<style| style=| on[a-z]+="/.test(read(name)))).toEqual([]));

  it('have one heading of their own', () =>
    expect(pages().filter((name) => all(read(name), /<(h1) /g).length !== 1)).toEqual([]));

  it('are found by the name of their folder', () =>
    expect(readFileSync(join(parent, 'docs.html'), 'utf8')).toContain('url=docs/'));
});
