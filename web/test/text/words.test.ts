import { describe, expect, it } from 'vitest';

import type { InputKind } from '../../src/practice/last_input';
import { tutorialText } from '../../src/text/tutorial_text';
import { readPaper } from '../structure/papers';
import {
  bannedIn,
  bannedPhrases,
  cataloguePaths,
  gradeOf,
  proseOf,
  readCatalogue,
  sentencesOf,
  stringsOf,
  wordsOf,
} from './catalogues';

const banned = bannedPhrases(readPaper('CONTRIBUTING.md'));
const catalogues = cataloguePaths();

const tooLong = (strings: readonly string[]) =>
  strings.flatMap(sentencesOf).filter((sentence) => wordsOf(sentence).length > 25);

const median = (values: readonly number[]) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)] ?? NaN;

/** The tutorial puts its sentences together: here as they are read. */
function tutorialSentences(): string[] {
  const { todo, strayed } = tutorialText;
  const inputs: readonly InputKind[] = ['mouse', 'touch', 'keys', 'gamepad'];
  return inputs.flatMap((input) => [
    ...Object.values(todo).map((of) => of('1.00')[input]),
    ...Object.values(strayed).map((of) => of(input)),
  ]);
}

describe('Words of the page', () => {
  it('are found', () => {
    expect(catalogues).toEqual(expect.arrayContaining(['text/app_text.ts', 'text/tutorial_text.ts']));
    expect(readCatalogue('text/app_text.ts')).toEqual(expect.arrayContaining(['Practise', 'Bone temperature']));
    expect(banned).toEqual(expect.arrayContaining(['go on', 'take part', "surgeon's eye"]));
  });

  it.each(catalogues)('of %s have no phrase of the column "not"', (path) => {
    const found = readCatalogue(path).flatMap((text) => bannedIn(text, banned).map((phrase) => `${phrase}: ${text}`));
    expect(found).toEqual([]);
  });

  it('of the tutorial have none either when they are put together', () =>
    expect(tutorialSentences().filter((text) => bannedIn(text, banned).length > 0)).toEqual([]));

  it.each(catalogues)('of %s are sentences of at most 25 words', (path) =>
    expect(tooLong(readCatalogue(path))).toEqual([]),
  );

  it('of the tutorial are so when they are put together', () => expect(tooLong(tutorialSentences())).toEqual([]));

  it('are in short sentences', () => {
    const lengths = catalogues.flatMap((path) => proseOf(readCatalogue(path)).flatMap(sentencesOf));
    expect(median(lengths.map((sentence) => wordsOf(sentence).length))).toBeLessThan(12);
  });

  it.each(catalogues)('of %s are read at grade 9', (path) =>
    expect(gradeOf(proseOf(readCatalogue(path)))).toBeLessThanOrEqual(9),
  );
});

describe('The measures of words', () => {
  it('find a phrase whatever its case and apostrophe, but no part of a word', () => {
    expect(bannedIn('Press P to Go on.', ['go on', 'lean'])).toEqual(['go on']);
    expect(bannedIn('The surgeon’s eye', ["surgeon's eye"])).toEqual(["surgeon's eye"]);
    expect(bannedIn('A clean cargo one', ['go on', 'lean'])).toEqual([]);
  });

  it('read the table of the rules', () => {
    const paper =
      '## Words of the page\n\n| use | not | for |\n|---|---|---|\n| a | b, c d | e |\n\n## Glossary\n\n| f | g |\n';
    expect(bannedPhrases(paper)).toEqual(['b', 'c d']);
  });

  it('read every branch of a catalogue, but no keys and types', () => {
    const text =
      "import { a } from './b'; type C = 'not said'; export const t = { 'a-key': 'Said', d: (e: string) => (e === 'left' ? `On ${e} side` : 'Else'), f: ['x'].join(' and ') };";
    expect(stringsOf(text)).toEqual(['Said', 'On x side', 'Else', 'x']);
  });

  it('find a long sentence', () => {
    const word = 'bone ';
    expect(tooLong([`${word.repeat(25).trim()}. Short.`])).toEqual([]);
    expect(tooLong([`Short. ${word.repeat(26).trim()}.`])).toHaveLength(1);
  });

  it('grade a hard sentence above 9 and an easy one below', () => {
    const hard =
      'Interpretation of intraoperative measurements necessitates consideration of individual anatomical characteristics.';
    expect(gradeOf([hard])).toBeGreaterThan(9);
    expect(gradeOf(['Press the button to start. Then move the reamer to the bone.'])).toBeLessThan(5);
  });
});
