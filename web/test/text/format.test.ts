import { describe, expect, it } from 'vitest';

import { minutes, sentence } from '../../src/text/format';

describe('sentence', () => {
  it('begins with a capital and ends with a stop, once', () => {
    expect(sentence('name or password is wrong')).toBe('Name or password is wrong.');
    expect(sentence('Try again.')).toBe('Try again.');
    expect(sentence('')).toBe('');
  });
});

describe('minutes', () => {
  it('counts minutes, seconds and tenths', () => {
    expect([0, 0.04, 0.06, 9.94, 59.96, 60, 3599.99, 3725.5].map(minutes)).toEqual([
      '0:00.0',
      '0:00.0',
      '0:00.1',
      '0:09.9',
      '1:00.0',
      '1:00.0',
      '60:00.0',
      '62:05.5',
    ]);
  });
});
