// The words of the page as a person meets them: every string of every catalogue, and how easily it reads.
import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';

import { parse } from '../structure/source_graph';

const source = (path: string) => fileURLToPath(new URL(`../../src/${path}`, import.meta.url));

/** Paths of all catalogues below web/src. */
export function cataloguePaths(): string[] {
  const names = readdirSync(source('text')).filter((name) => name.endsWith('_text.ts'));
  return [...names.sort().map((name) => `text/${name}`), 'wire/problem_text.ts'];
}

export const readCatalogue = (path: string) => stringsOf(readFileSync(source(path), 'utf8'));

/** All strings of a catalogue, in every branch; what a caller puts in is "x". */
export function stringsOf(text: string): string[] {
  const found: string[] = [];
  const visit = (node: ts.Node): void => {
    if (ts.isImportDeclaration(node) || ts.isTypeNode(node)) return;
    if (ts.isTemplateExpression(node))
      found.push(node.head.text + node.templateSpans.map((span) => `x${span.literal.text}`).join(''));
    else if (ts.isStringLiteralLike(node) && isSaid(node)) found.push(node.text);
    ts.forEachChild(node, visit);
  };
  visit(parse('catalogue.ts', text));
  return found.map((each) => each.trim()).filter((each) => /\p{L}/u.test(each));
}

/** Whether it can be read on the page: no key, and nothing that is only compared or handed to a method. */
function isSaid(node: ts.StringLiteralLike): boolean {
  const { parent } = node;
  if (ts.isPropertyAssignment(parent) && parent.name === node) return false;
  if (ts.isBinaryExpression(parent) || ts.isElementAccessExpression(parent)) return false;
  return !(ts.isCallExpression(parent) && ts.isPropertyAccessExpression(parent.expression));
}

export const sentencesOf = (text: string) => text.split(/(?<=[.?!…])\s+/).filter((each) => /\p{L}/u.test(each));

export const wordsOf = (text: string) => text.match(/[\p{L}\p{N}][\p{L}\p{N}.,’'-]*/gu) ?? [];

/** Strings that are sentences rather than labels. */
export const proseOf = (strings: readonly string[]) => strings.filter((each) => wordsOf(each).length >= 5);

/** Flesch-Kincaid: the year of school in which it is read with ease. */
export function gradeOf(prose: readonly string[]): number {
  const sentences = prose.flatMap(sentencesOf);
  const words = sentences.flatMap(wordsOf);
  if (words.length === 0) return 0;
  const syllables = words.map(syllablesOf).reduce((sum, each) => sum + each, 0);
  return 0.39 * (words.length / sentences.length) + 11.8 * (syllables / words.length) - 15.59;
}

/** Groups of vowels, without a silent e. */
function syllablesOf(word: string): number {
  const spoken = word.toLowerCase().replace(/(?<=[^aeiouyl])es?$|(?<=[^aeiouytd])ed$/, '');
  return Math.max(1, spoken.match(/[aeiouy]+/g)?.length ?? 0);
}

/** Phrases that no catalogue has, from the column "not" of the table under "Words of the page". */
export function bannedPhrases(contributing: string): string[] {
  const section = contributing.split(/^## /m).find((each) => each.startsWith('Words of the page')) ?? '';
  const rows = section.split('\n').filter((line) => line.startsWith('| ') && !line.startsWith('| use |'));
  const cells = rows.map((line) => line.split('|')[2] ?? '');
  return cells.flatMap((cell) => cell.split(',').map((each) => each.trim())).filter((each) => each !== '');
}

const straight = (text: string) => text.replaceAll('’', "'");

/** Which of the phrases a string has as whole words. */
export function bannedIn(text: string, phrases: readonly string[]): string[] {
  return phrases.filter((phrase) =>
    new RegExp(`(?<![\\p{L}-])${straight(phrase)}(?![\\p{L}-])`, 'iu').test(straight(text)),
  );
}
