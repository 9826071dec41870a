// The papers of the project as text: what they link to, and how long their sentences are.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join, normalize, relative } from 'node:path';

export const repository = new URL('../../../', import.meta.url).pathname;
const root = repository;

/** Names of all papers, from the root. Guides that lie beside what they are about count as papers, too. */
export function paperNames(): string[] {
  const below = (folder: string) =>
    readdirSync(join(root, folder))
      .filter((name) => name.endsWith('.md'))
      .map((name) => normalize(join(folder, name)));
  return ['.', 'docs', 'examples', 'proto', 'server/device', 'server/openigtlink'].flatMap(below);
}

export const readPaper = (name: string) => readFileSync(join(root, name), 'utf8');

const withoutCode = (text: string) => text.replace(/^```[\s\S]*?^```/gm, '');

/** As pages of repositories name a heading in an address. */
export function anchorOf(heading: string): string {
  return heading
    .toLowerCase()
    .replace(/[^\p{L}\p{N} _-]/gu, '')
    .replace(/ /g, '-');
}

const anchorsOf = (text: string) =>
  [...withoutCode(text).matchAll(/^#+ (.+)$/gm)].map(([, heading = '']) => anchorOf(heading));

/** Links of a paper into this repository that lead nowhere. */
export function deadLinks(name: string, text: string): string[] {
  const dead: string[] = [];
  for (const [, target = ''] of withoutCode(text).matchAll(/\]\(([^)\s]+)\)/g)) {
    if (/^[a-z]+:/.test(target)) continue;
    const [path = '', anchor] = target.split('#');
    const file = path === '' ? name : relative(root, join(root, dirname(name), path));
    if (!existsSync(join(root, file))) dead.push(target);
    else if (anchor !== undefined && !anchorsOf(readPaper(file)).includes(anchor)) dead.push(target);
  }
  return dead;
}

/** Sentences of a paper's running text: no headings, tables, code, lists of keys or pictures. */
export function sentences(text: string): string[] {
  const lines = withoutCode(text).split('\n');
  const paragraphs: string[] = [''];
  for (const line of lines) {
    if (/^\s*$|^#|^\||^!\[|^<|^\*.*\*$/.test(line)) paragraphs.push('');
    else if (/^\s*([-*]|\d+\.) /.test(line)) paragraphs.push(line.replace(/^\s*([-*]|\d+\.) /, ''));
    else paragraphs.push(`${paragraphs.pop() ?? ''} ${line}`);
  }
  return paragraphs
    .flatMap((paragraph) =>
      paragraph
        .replace(/`[^`]*`/g, 'x')
        .replace(/\[([^\]]*)\]\([^)]*\)/g, '$1')
        .split(/(?<=[.:;?!])\s+(?=\S)/),
    )
    .map((sentence) => sentence.trim())
    .filter((sentence) => sentence !== '');
}

export const wordCount = (sentence: string) =>
  sentence.split(/\s+/).filter((word) => /[\p{L}\p{N}]/u.test(word)).length;

/** Blocks of a paper that are to be run as they stand: those that begin with "```sh run". */
export const runnableBlocks = (text: string) =>
  [...text.matchAll(/^```sh run\n([\s\S]*?)^```$/gm)].map(([, block = '']) => block);
