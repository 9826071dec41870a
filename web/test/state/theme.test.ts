import { describe, expect, it } from 'vitest';

import { Theme } from '../../src/state/theme';

class FakeScheme {
  matches = false;
  private readonly heard: (() => void)[] = [];
  addEventListener = (_: string, listener: unknown) => void this.heard.push(listener as () => void);
  turn(dark: boolean): void {
    this.matches = dark;
    this.heard.forEach((listener) => listener());
  }
}

function begun(kept: Map<string, string>): { theme: Theme; scheme: FakeScheme; shown: string[] } {
  const theme = new Theme();
  const scheme = new FakeScheme();
  const shown: string[] = [];
  const storage = {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => void kept.set(key, value),
  };
  theme.begin(storage, scheme, (one) => shown.push(one));
  return { theme, scheme, shown };
}

describe('Theme', () => {
  it('follows the system until something is chosen', () => {
    const { theme, scheme, shown } = begun(new Map());
    scheme.turn(true);
    theme.next();
    scheme.turn(false);
    scheme.turn(true);
    expect([theme.choice.value, shown]).toEqual(['light', ['light', 'dark', 'light']]);
    theme.next();
    expect(shown.at(-1)).toBe('dark');
    theme.next();
    expect(theme.choice.value).toBe('system');
  });

  it('keeps the choice, and takes what it does not know for none', () => {
    const kept = new Map<string, string>();
    begun(kept).theme.next();
    expect(begun(kept).theme.choice.value).toBe('light');
    expect(begun(new Map([['ream.theme', 'purple']])).theme.choice.value).toBe('system');
  });

  it('works in a browser that keeps nothing', () => {
    const theme = new Theme();
    const refuse = () => {
      throw new Error('denied');
    };
    const shown: string[] = [];
    theme.begin({ getItem: refuse, setItem: refuse }, new FakeScheme(), (one) => shown.push(one));
    theme.choice.value = 'dark';
    expect(shown).toEqual(['light', 'dark']);
  });
});
