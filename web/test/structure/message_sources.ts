// What the program and the page can say to people: the text of their sources, with string literals joined.
import { readdirSync, readFileSync } from 'node:fs';
import { extname, join } from 'node:path';

import { repository } from './papers';

const folders: readonly [string, string][] = [
  ['server', '.cpp'],
  ['web/src/text', '.ts'],
  ['web/src/wire', '.ts'],
];

/** Adjacent literals become one, as compilers read them; quotes within them lose their escape. */
const joined = (source: string) => source.replace(/"\s*\n\s*"/g, '').replace(/\\(["'])/g, '$1');

export function messageSources(): string[] {
  return folders.flatMap(([folder, ending]) =>
    readdirSync(join(repository, folder), { recursive: true, encoding: 'utf8' })
      .filter((name) => extname(name) === ending && !name.includes('generated'))
      .map((name) => joined(readFileSync(join(repository, folder, name), 'utf8'))),
  );
}

/** Messages in the first column of a paper's tables. */
export function quotedMessages(text: string): string[] {
  const firstCells = [...text.matchAll(/^\| (.*?) \|/gm)].map(([, cell = '']) => cell);
  return firstCells.flatMap((cell) => [...cell.matchAll(/`([^`]+)`/g)].map(([, message = '']) => message));
}

/** Whether one source has all parts of a message, between its gaps. */
export function isSaid(message: string, sources: readonly string[]): boolean {
  const parts = message
    .split('…')
    .map((part) => part.trim())
    .filter((part) => part !== '' && part !== ';');
  return sources.some((source) => parts.every((part) => source.includes(part)));
}
