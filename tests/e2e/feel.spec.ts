// A blind study of feel: two plates are reamed in theatre, a question is answered, and nobody is told whether rightly.
import { readFileSync } from 'node:fs';

import { AxeBuilder } from '@axe-core/playwright';
import { type Browser, expect, type Page, test } from '@playwright/test';

import { logIn, readout, serverForEachTest } from './server_for_each_test';
import type { TestUser } from './server_process';

const olga: TestUser = { name: 'olga', role: 'operator', displayName: 'Olga Operator' };
const ines: TestUser = { name: 'ines', role: 'instructor', displayName: 'Ines Instructor' };
const tom: TestUser = { name: 'tom', role: 'trainee', displayName: 'Tom Trainee' };

const here = serverForEachTest([olga, ines, tom]);
const study = 'Who feels dense bone?';

/** A window of somebody's own. */
async function windowOf(browser: Browser, user: TestUser): Promise<Page> {
  const page = await (await browser.newContext()).newPage();
  here.watchForErrors(page);
  await page.goto(here.server.url);
  await logIn(page, user.name);
  await expect(page.getByTestId('current-user')).toContainText(user.displayName);
  return page;
}

/** With one question and two trials. */
async function makeStudy(page: Page): Promise<void> {
  await expect
    .poll(async () => (await page.request.get(`${here.server.url}/readyz`)).status(), { timeout: 60_000 })
    .toBe(200);
  await page.getByTestId('to-studies').click();
  await page.getByTestId('study-name').fill(study);
  await page.getByTestId('study-kind').selectOption('feel');
  await expect(page.getByTestId('study-design')).toBeHidden();
  await expect(page.getByTestId('study-case-demo')).toBeHidden();
  await expect(page.getByTestId('feel-trial-count')).toContainText('32 trials');
  for (const comparison of ['cartilage', 'bone_under_cartilage', 'through_plate'])
    await page.getByTestId(`feel-${comparison}`).uncheck();
  await page.getByTestId('feel-trials').selectOption('2');
  await expect(page.getByTestId('feel-trial-count')).toContainText('2 trials');
  await page.getByTestId('make-study').click();
  await expect(page.getByTestId('study-title')).toHaveText(study);
  await expect(page.getByTestId('show-validity')).toHaveCount(0);
}

/** The new participant's code. */
async function enrol(page: Page, experience: string): Promise<string> {
  await page.getByTestId('experience').selectOption(experience);
  await page.getByTestId('enrol').click();
  return /[2-9A-Z]{2}-[2-9A-Z]{3}/.exec((await page.getByTestId('enrolled').textContent()) ?? '')?.[0] ?? '';
}

async function openStudy(page: Page): Promise<void> {
  await page.getByTestId('to-studies').click();
  await page.getByRole('link', { name: study }).click();
}

/** Until so much more bone is gone. */
async function ream(page: Page, mm3: number): Promise<void> {
  const before = (await readout(page)).removedMm3 ?? 0;
  await page.keyboard.down(' ');
  await expect
    .poll(async () => (await readout(page)).removedMm3 ?? 0, { timeout: 120_000 })
    .toBeGreaterThan(before + mm3);
  await page.keyboard.up(' ');
}

async function hold(page: Page, key: string, ms: number): Promise<void> {
  await page.keyboard.down(key);
  await page.waitForTimeout(ms);
  await page.keyboard.up(key);
}

/** From the study into theatre, reaming the upper plate and the lower one, and to the end of the session. */
async function feelPlates(page: Page): Promise<void> {
  await page.getByTestId('feel-plates').click();
  await expect(page.getByTestId('trainee-page')).toHaveAttribute('data-theatre', 'true', { timeout: 60_000 });
  await page.waitForFunction(() => window.__ream.deviceLink === 'holding' && window.__ream.live, null, {
    timeout: 60_000,
  });
  await page.getByTestId('bone-canvas').focus();
  await page.keyboard.press('s');
  // The reamer begins between the plates; an arrow moves it by 8 mm a second, up to 20 mm.
  await hold(page, 'ArrowUp', 3_000);
  await ream(page, 1);
  await hold(page, 'b', 1_500);
  await hold(page, 'ArrowDown', 6_000);
  await ream(page, 1);
  await page.getByTestId('end-theatre').click();
  await expect(page.getByTestId('feel-session')).toBeVisible();
}

async function savedBy(page: Page, testId: string): Promise<string> {
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByTestId(testId).click()]);
  return readFileSync(await download.path(), 'utf8');
}

async function serious(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations.filter(({ impact }) => impact === 'serious' || impact === 'critical').map(({ id }) => id);
}

test('a participant feels plates and answers, trial after trial; the operator reads how often that was right', async ({
  browser,
}) => {
  test.setTimeout(300_000);
  const operator = await windowOf(browser, olga);
  await makeStudy(operator);
  await operator.getByTestId('enrol-user').selectOption({ label: 'Tom Trainee' });
  const code = await enrol(operator, 'novice');
  expect(code).not.toBe('');

  const trainee = await windowOf(browser, tom);
  await openStudy(trainee);
  await expect(trainee.getByTestId('own-code')).toContainText(code);
  await expect(trainee.getByTestId('feel-trial')).toHaveText('Trial 1 of 2');
  await expect(trainee.getByTestId('feel-question')).not.toHaveText('');
  await expect(trainee.getByTestId('answer-upper')).toHaveCount(0);
  expect(await serious(trainee)).toEqual([]);

  // After the session nothing tells what the plates were made of, and the answer is one key away.
  await feelPlates(trainee);
  for (const id of [
    'bone-canvas',
    'result-card',
    'show-result',
    'results',
    'removed-volume',
    'sessions',
    'next-attempt',
  ])
    await expect(trainee.getByTestId(id)).toHaveCount(0);
  await expect(trainee.getByTestId('answer-now')).toBeFocused();
  expect(await serious(trainee)).toEqual([]);
  await trainee.keyboard.press('Enter');
  await expect(trainee.getByTestId('feel-trial')).toHaveText('Trial 1 of 2');
  await expect(trainee.getByTestId('feel-plates')).toHaveText('Feel the plates again');
  for (const plate of ['upper', 'lower'])
    expect((await trainee.getByTestId(`answer-${plate}`).boundingBox())?.height).toBeGreaterThanOrEqual(44);
  expect(await serious(trainee)).toEqual([]);
  await trainee.getByTestId('answer-upper').click();
  await expect(trainee.getByTestId('feel-trial')).toHaveText('Trial 2 of 2');
  await expect(trainee.getByTestId('feel-plates')).toHaveText('Feel the plates');
  expect(await trainee.locator('main').innerText()).not.toMatch(/right|wrong|correct/i);

  await feelPlates(trainee);
  await trainee.getByTestId('answer-now').click();
  await expect(trainee.getByTestId('answer-lower')).toBeVisible();
  await trainee.reload();
  await trainee.getByTestId('answer-lower').focus();
  await trainee.keyboard.press('Enter');
  await expect(trainee.getByTestId('feel-done')).toHaveText('You have answered all trials. Thank you.');

  await operator.reload();
  await operator.getByTestId('show-feel-report').click();
  await expect(operator.getByTestId('feel-report')).toContainText('One participant has answered.');
  await expect(operator.getByTestId('feel-line-density')).toContainText(
    'answered all trials: 1; at least 3 are needed',
  );
  expect(await serious(operator)).toEqual([]);
  const answers = await savedBy(operator, 'feel-answers-csv');
  expect(answers.trim().split(/\r?\n/)).toHaveLength(3);
  expect(answers).toContain(code);
  expect(answers).not.toMatch(/Tom|tom/);
});

test(
  'an instructor runs the trials of somebody without an account, and sees the report when the study is closed',
  { tag: '@full' },
  async ({ browser }) => {
    const page = await windowOf(browser, ines);
    await makeStudy(page);
    const code = await enrol(page, 'expert');
    await page.getByTestId('train-as').selectOption(code);
    await expect(page.getByTestId('feel-trial')).toHaveText('Trial 1 of 2');
    await feelPlates(page);
    await page.getByTestId('answer-now').click();
    await expect(page.getByTestId('train-as')).toHaveValue(code);
    await page.getByTestId('answer-lower').click();
    await expect(page.getByTestId('feel-trial')).toHaveText('Trial 2 of 2');
    await expect(page.getByTestId('show-feel-report')).toBeDisabled();
    await page.getByTestId('close-study').click();
    await page.getByTestId('confirm-close-study').click();
    await expect(page.getByTestId('study-state')).toHaveText('Closed');
    await expect(page.getByTestId('feel-panel')).toHaveCount(0);
    await page.getByTestId('show-feel-report').click();
    await expect(page.getByTestId('feel-line-density')).toBeVisible();
  },
);

test('who plans a study is told how many participants it needs', async ({ browser }) => {
  const page = await windowOf(browser, ines);
  await page.getByTestId('to-studies').click();
  await page.getByTestId('sample-size').locator('summary').click();
  // Cohen 1988: two groups, a large difference, p < 0.05, power 80 %.
  await expect(page.getByTestId('sample-answer')).toContainText('26 people in each of two groups.');
  await page.getByTestId('sample-question').selectOption('agreement');
  await expect(page.getByTestId('sample-answer')).toContainText('each rated by 2 raters.');
  await page.getByTestId('sample-least').fill('0.9');
  await expect(page.getByTestId('sample-problem')).toBeVisible();
  await page.getByTestId('sample-least').fill('0.6');
  await expect(page.getByTestId('sample-answer')).toContainText('sessions');
  await expect(page.getByTestId('sample-problem')).toHaveCount(0);
  expect(await serious(page)).toEqual([]);
});
