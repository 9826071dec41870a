import { spawnSync } from 'node:child_process';

import { describe, expect, it } from 'vitest';

import { anchorOf, deadLinks, paperNames, readPaper, repository, sentences, wordCount } from './papers';

describe('Papers', () => {
  const names = paperNames();

  it('are found', () => expect(names).toEqual(expect.arrayContaining(['README.md', 'docs/trainee.md'])));

  it.each(names)('%s leads nowhere that is not there', (name) => expect(deadLinks(name, readPaper(name))).toEqual([]));

  it.each(names.filter((name) => !/CHANGELOG|LICENSE/.test(name)))(
    '%s has sentences that are read in one breath',
    (name) => {
      const lengths = sentences(readPaper(name)).map(wordCount);
      expect(lengths.length).toBeGreaterThan(4);
      const long = lengths.filter((words) => words > 25).length;
      expect(long / lengths.length, `${long} of ${lengths.length}`).toBeLessThanOrEqual(0.1);
    },
  );

  it('have the tables that follow from the program', () => {
    const { status, stderr } = spawnSync('python3', ['scripts/write-reference', '--check'], {
      cwd: repository,
      encoding: 'utf8',
    });
    expect(status, stderr).toBe(0);
  });

  it('begin with a page that is one page', () => {
    const text = readPaper('README.md');
    expect(text.split('\n').length).toBeLessThanOrEqual(150);
    expect(sentences(text).filter((sentence) => wordCount(sentence) > 30)).toEqual([]);
  });

  it('are measured as people read them', () => {
    const text =
      '# Head\n\nOne two. Three\nfour `a b c` [five](six.md): seven.\n\n- eight; nine\n\n| a | b |\n\n```\ncode here\n```\n';
    expect(sentences(text)).toEqual(['One two.', 'Three four x five:', 'seven.', 'eight;', 'nine']);
    expect(wordCount('Thrust — 52 N, ...')).toBe(3);
    expect(anchorOf('What a version promises, `now`')).toBe('what-a-version-promises-now');
    expect(
      deadLinks('README.md', '[a](docs/none.md) [b](#nowhere) [c](docs/trainee.md#depth) [d](https://x.org)'),
    ).toEqual(['docs/none.md', '#nowhere']);
  });
});
