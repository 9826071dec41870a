// The page's colours hold WCAG 2.1 AA in both themes: 4.5 for text, 3 for what bounds a control or is a sign.
import { readdirSync, readFileSync } from 'node:fs';

import { describe, expect, it } from 'vitest';

const css = readFileSync(new URL('../src/styles/base.css', import.meta.url), 'utf8');

function coloursOf(selector: string): Map<string, string> {
  const at = css.indexOf(`${selector} {`);
  const block = css.slice(at, css.indexOf('}', at));
  return new Map([...block.matchAll(/--([a-z-]+):\s*(#[0-9a-f]{6});/g)].map(([, name = '', hex = '']) => [name, hex]));
}

function luminance(hex: string): number {
  const [red = 0, green = 0, blue = 0] = [1, 3, 5].map((at) => {
    const value = parseInt(hex.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

function contrast(a: string, b: string): number {
  const [low = 0, high = 0] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

const texts = ['text', 'text-soft', 'accent', 'good', 'warn', 'bad', 'pass', 'fail', 'undecided'];
const pairs: [string, string, number][] = [
  ...['ground', 'panel'].flatMap((ground) => [
    ...texts.map((text): [string, string, number] => [text, ground, 4.5]),
    ['edge', ground, 3] as [string, string, number],
    ['force', ground, 3] as [string, string, number],
  ]),
  ['text', 'bad-ground', 4.5],
  ['bad', 'bad-ground', 4.5],
  ['accent-text', 'accent', 4.5],
  ['accent-text', 'accent-strong', 4.5],
  ['accent-text', 'replay', 4.5],
  ['text', 'line', 4.5],
];

describe.each([
  ['light', ':root'],
  ['dark', ":root[data-theme='dark']"],
])('%s', (_, selector) => {
  const colours = coloursOf(selector);
  it.each(pairs)('%s on %s', (one, other, least) => {
    expect(contrast(colours.get(one) ?? '', colours.get(other) ?? '')).toBeGreaterThanOrEqual(least);
  });
});

/** The value that a button of a choice has in a state, by the style sheet's own rules. */
function ofChoice(property: string, { pressed, disabled }: { pressed: boolean; disabled: boolean }): string {
  const holds: Record<string, boolean> = {
    "[aria-pressed='true']": pressed,
    ":not([aria-pressed='true'])": !pressed,
    ':disabled': disabled,
  };
  const review = readFileSync(new URL('../src/styles/review.css', import.meta.url), 'utf8');
  let best = { value: '', rank: -1 };
  for (const [, suffix = '', body = ''] of review.matchAll(/^\.choice button([^\s{,+]*) \{([^}]*)\}/gm)) {
    const parts = suffix.match(/:not\([^)]*\)|\[[^\]]*\]|:[a-z-]+/g) ?? [];
    const value = new RegExp(`(?:^|\\s)${property}: var\\(--([a-z-]+)\\)`).exec(body)?.[1];
    if (value !== undefined && parts.every((part) => holds[part]) && parts.length >= best.rank)
      best = { value, rank: parts.length };
  }
  return best.value;
}

describe.each([
  ['light', ':root'],
  ['dark', ":root[data-theme='dark']"],
])('a choice, %s', (_, selector) => {
  const colours = coloursOf(selector);
  it.each([
    [false, false],
    [true, false],
    [false, true],
    [true, true],
  ])('can be read (pressed %s, disabled %s)', (pressed, disabled) => {
    const [text, ground] = [ofChoice('color', { pressed, disabled }), ofChoice('background', { pressed, disabled })];
    expect(contrast(colours.get(text) ?? '', colours.get(ground) ?? '')).toBeGreaterThanOrEqual(4.5);
  });
});

it('links have the colour of the theme, not the browser’s', () => {
  expect(css).toMatch(/^a \{\s*color: var\(--accent\);\s*\}/m);
});

it('outcomes have their colours from one place', () => {
  const folder = new URL('../src/styles/', import.meta.url);
  const naming = readdirSync(folder).filter((name) =>
    /\.(outcome|verdict)-(pass|fail|undecided|warn)\b/.test(readFileSync(new URL(name, folder), 'utf8')),
  );
  expect(naming).toEqual(['outcome.css']);
});
