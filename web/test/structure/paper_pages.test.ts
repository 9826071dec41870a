// Papers as pages: every link and picture is there, and nothing in them breaks the server's rules for pages.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { paperNames, repository } from './papers';

const parent = mkdtempSync(join(tmpdir(), 'ream-pages-'));
const folder = join(parent, 'docs');
const read = (name: string) => readFileSync(join(folder, name), 'utf8');
const pages = () => readdirSync(folder).filter((name) => name.endsWith('.html'));
const all = (text: string, pattern: RegExp) => [...text.matchAll(pattern)].map(([, found = '']) => found);

/** Of the program's page, beside whose folder the guides lie. */
const ofTheProgram = ['../', '../third-party.txt'];

function deadLinksOf(name: string): string[] {
  return all(read(name), /(?:href|src)="([^"]+)"/g).filter((target) => {
    if (/^[a-z]+:/.test(target) || ofTheProgram.includes(target)) return false;
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

  it('have an icon, so that no browser asks for one that is not there', () => {
    const texts = [...pages().map(read), readFileSync(`${folder}.html`, 'utf8')];
    expect(texts.filter((text) => !text.includes('<link rel="icon" href="data:,">'))).toEqual([]);
  });

  it('have one heading of their own', () =>
    expect(pages().filter((name) => all(read(name), /<(h1) /g).length !== 1)).toEqual([]));

  it('are not made of a table that would lose a cell', () => {
    const papers = join(parent, 'papers');
    const made = (row: string) => {
      mkdirSync(papers, { recursive: true });
      writeFileSync(join(papers, 'README.md'), `# Some\n\n| a | b |\n|---|---|\n| \`x\\|y\` | 2 |\n${row}\n`);
      return spawnSync('node', ['web/scripts/papers.mjs', join(parent, 'some'), '--of', papers], {
        cwd: repository,
        encoding: 'utf8',
      });
    };
    expect(made('| 3 | 4 |').status).toBe(0);
    for (const row of ['| 3 | 4 | 5 |', '| 3 |']) {
      const { status, stderr } = made(row);
      expect(status).not.toBe(0);
      expect(stderr).toContain(
        `README.md: a row has ${row.split('|').length - 2} cells, its table's heading 2: ${row}`,
      );
    }
  });

  it('are found by the name of their folder', () =>
    expect(readFileSync(join(parent, 'docs.html'), 'utf8')).toContain('url=docs/'));
});
