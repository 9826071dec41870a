import { describe, expect, it } from 'vitest';

import { clock, dayAndTime, dayYearAndTime, duration, minutes, percent, sentence } from '../../src/text/format';

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

describe('duration', () => {
  it('has units', () => {
    expect([0, 37.46, 59.96, 123.8, 3599.6, 3725.5].map(duration)).toEqual([
      '0.0 s',
      '37.5 s',
      '1 min 00 s',
      '2 min 04 s',
      '1 h 00 min',
      '1 h 02 min',
    ]);
  });
});

describe('percent', () => {
  it('says 100 only of what is complete, and never leaves 0 to 100', () => {
    expect([-1, 0, 0.029, 0.07, 0.29, 0.999, 1, 1.5].map(percent)).toEqual([
      '0 %',
      '0 %',
      '2 %',
      '7 %',
      '29 %',
      '99 %',
      '100 %',
      '100 %',
    ]);
  });
});

describe('dates', () => {
  const now = new Date('2026-11-27T12:00:00Z');
  it('have the year where it is not this one', () => {
    expect(dayAndTime('2026-06-15T12:00:00Z', now)).not.toContain('2026');
    expect(dayAndTime('2025-06-15T12:00:00Z', now)).toContain('2025');
    expect(dayAndTime('2027-06-15T12:00:00Z', now)).toContain('2027');
  });

  it('always have it where they lie ahead', () => {
    const year = new Date().getFullYear();
    expect(dayYearAndTime(`${year}-06-15T12:00:00Z`)).toContain(String(year));
  });

  it('count the hours from 0 to 23', () => {
    const [night, evening] = [new Date(2026, 5, 15, 0, 5, 6), new Date(2026, 5, 15, 19, 9, 16)];
    for (const [at, hour] of [
      [night, '00'],
      [evening, '19'],
    ] as const) {
      expect(clock(at.getTime())).toMatch(new RegExp(`^${hour}\\D`));
      expect(clock(at.getTime())).not.toMatch(/[ap]m/i);
      expect(dayAndTime(at.toISOString(), now)).toMatch(new RegExp(`${hour}\\D\\d\\d$`));
    }
  });
});
