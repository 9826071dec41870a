// A study from its making to its export: people take part by code, train, answer, and stay unknown to who watches.
import { readFileSync } from 'node:fs';

import { type Browser, expect, type Page, test } from '@playwright/test';

import { reamByKeysUntil } from './ream_a_moment';
import { logIn, serverForEachTest } from './server_for_each_test';
import type { TestUser } from './server_process';

const olga: TestUser = { name: 'olga', role: 'operator', displayName: 'Olga Operator' };
const ines: TestUser = { name: 'ines', role: 'instructor', displayName: 'Ines Instructor' };
const tom: TestUser = { name: 'tom', role: 'trainee', displayName: 'Tom Trainee' };

const here = serverForEachTest([olga, ines, tom]);

/** A window of somebody's own. */
async function windowOf(browser: Browser, user: TestUser): Promise<Page> {
  const page = await (await browser.newContext()).newPage();
  here.watchForErrors(page);
  await page.goto(here.server.url);
  await logIn(page, user.name);
  await expect(page.getByTestId('current-user')).toContainText(user.displayName);
  return page;
}

/** The demo case has to be there before a study can name it. */
async function makeStudy(page: Page): Promise<string> {
  await expect
    .poll(async () => (await page.request.get(`${here.server.url}/readyz`)).status(), { timeout: 60_000 })
    .toBe(200);
  await page.getByTestId('to-studies').click();
  await page.getByTestId('study-name').fill('Who presses too hard?');
  await expect(page.getByTestId('study-case-demo')).toBeChecked();
  await page.getByTestId('make-study').click();
  await expect(page.getByTestId('study-title')).toHaveText('Who presses too hard?');
  return (await page.getByTestId('study-join-code').textContent()) ?? '';
}

async function join(page: Page, joinCode: string): Promise<string> {
  await page.getByTestId('to-studies').click();
  await page.getByTestId('join-code').fill('nonsense');
  await page.getByTestId('experience').selectOption('novice');
  await page.getByTestId('join').click();
  await expect(page.getByTestId('join-problem')).toBeVisible();
  await page.getByTestId('join-code').fill(joinCode);
  await page.getByTestId('join').click();
  await expect(page.getByTestId('own-code')).toBeVisible();
  return /[2-9A-Z]{2}-[2-9A-Z]{3}/.exec((await page.getByTestId('own-code').textContent()) ?? '')?.[0] ?? '';
}

/** Takes the reamer into the hand for some seconds of session time. */
async function train(page: Page): Promise<void> {
  await page.getByTestId('train').click();
  await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
  await page.waitForFunction(() => (window.__ream.lastTick ?? 0) > 300, null, { timeout: 60_000 });
}

async function savedBy(page: Page, testId: string): Promise<string> {
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByTestId(testId).click()]);
  return readFileSync(await download.path(), 'utf8');
}

test('a trainee takes part, trains and answers; who watches sees the code until an operator unblinds', async ({
  browser,
}) => {
  const instructor = await windowOf(browser, ines);
  const joinCode = await makeStudy(instructor);
  const trainee = await windowOf(browser, tom);
  const code = await join(trainee, joinCode);
  expect(code).not.toBe('');

  await train(trainee);
  await instructor.getByTestId('all-studies').click();
  await instructor.getByRole('link', { name: 'Who presses too hard?' }).click();
  await expect(instructor.getByTestId(`participant-${code}`)).toContainText('hidden');
  await instructor.getByTestId('to-live').click();
  await expect(instructor.getByTestId('study-line')).toHaveText(`Study Who presses too hard? · ${code} · attempt 1`, {
    timeout: 60_000,
  });
  expect(await instructor.locator('body').innerText()).not.toContain('Tom');
  await trainee.getByTestId('stop').click();
  await expect(trainee.getByTestId('session-state')).toHaveAttribute('data-state', 'stopped');

  // The way on leads to another attempt in the study, not out of it.
  await expect(trainee.getByTestId('study-line')).toHaveText(`Study Who presses too hard? · ${code} · attempt 1`);
  await expect(trainee.getByTestId('practise')).toHaveText('Practise outside the study');
  await trainee.getByTestId('next-attempt').click();
  await expect(trainee.getByTestId('session-state')).toHaveAttribute('data-state', 'running', { timeout: 60_000 });
  await expect(trainee.getByTestId('study-line')).toContainText('attempt 2');
  const attempts = await trainee.evaluate(async () => {
    const answer = (await (await fetch('/api/v1/sessions')).json()) as { sessions: { participant: string | null }[] };
    return answer.sessions.map((session) => session.participant);
  });
  expect(attempts.filter((participant) => participant !== null)).toEqual([code, code]);
  await trainee.getByTestId('stop').click();
  await expect(trainee.getByTestId('session-state')).toHaveAttribute('data-state', 'stopped');

  // By keys alone: what is missing is said and gone to, then every statement is answered.
  await trainee.getByTestId('questionnaire-notice').getByRole('link').click();
  await expect(trainee.getByTestId('questionnaire')).toBeVisible();
  await trainee.getByTestId('send-answers').focus();
  await trainee.keyboard.press('Enter');
  await expect(trainee.getByTestId('missing')).toContainText('answers are missing');
  await expect(trainee.getByTestId('bone_appearance-1')).toBeFocused();
  const groups = await trainee
    .getByRole('group')
    .filter({ has: trainee.getByRole('radio') })
    .all();
  for (const group of groups.filter((_, i) => i >= 0)) {
    const first = group.getByRole('radio').first();
    await first.focus();
    await trainee.keyboard.press('Space');
    await trainee.keyboard.press('ArrowRight');
  }
  await expect(trainee.getByTestId('bone_appearance-2')).toBeChecked();
  await trainee.getByTestId('vibration-none').check();
  await trainee.getByTestId('remarks-text').fill('More bone, please.');
  await trainee.getByTestId('send-answers').click();
  await expect(trainee.getByTestId('answers-status')).toContainText('Thank you');
  await trainee.reload();
  await expect(trainee.getByTestId('vibration-none')).toBeChecked();
  await expect(trainee.getByTestId('remarks-text')).toHaveValue('More bone, please.');

  const operator = await windowOf(browser, olga);
  await operator.getByTestId('to-studies').click();
  await operator.getByRole('link', { name: 'Who presses too hard?' }).click();
  await expect(operator.getByTestId(`participant-${code}`)).toContainText('Novice');
  const answers = await savedBy(operator, 'export-answers');
  expect(answers.split('\r\n')[0]).toContain('bone_appearance');
  expect(answers).toContain(code);
  for (const table of ['export-sessions', 'export-answers', 'export-groups', 'export-json'])
    expect(await savedBy(operator, table)).not.toMatch(/Tom|tom/);
  expect(await savedBy(operator, 'export-sessions')).toContain(`${code},novice,0,1,1,demo`);
  expect(await savedBy(operator, 'export-codebook')).toContain('reaming_depth_mm');
  await operator.getByTestId('show-persons').click();
  await expect(operator.getByTestId(`participant-${code}`)).toContainText('Tom Trainee');

  await operator.getByTestId('close-study').click();
  await operator.getByTestId('confirm-close-study').click();
  await expect(operator.getByTestId('study-state')).toHaveText('Closed');
  await operator.getByTestId('unblind-study').click();
  await operator.getByTestId('confirm-unblind-study').click();
  await expect(operator.getByTestId('unblind-study')).toBeHidden();
  await instructor.getByTestId('to-sessions').click();
  await expect(instructor.getByTestId('session-table')).toContainText('Tom Trainee');
  await trainee.reload();
  await expect(trainee.getByTestId('send-answers')).toBeDisabled();
});

test(
  'an instructor enrols somebody without an account and trains with their code',
  { tag: '@full' },
  async ({ browser }) => {
    const page = await windowOf(browser, ines);
    await makeStudy(page);
    await expect(page.getByTestId('copy-join-code')).toHaveAccessibleName('Copy join code');
    await expect(page.getByTestId('enrol-user')).toBeHidden();
    await page.getByTestId('experience').selectOption('expert');
    await page.getByTestId('procedures').fill('120');
    await page.getByTestId('enrol').click();
    const code = /[2-9A-Z]{2}-[2-9A-Z]{3}/.exec((await page.getByTestId('enrolled').textContent()) ?? '')?.[0] ?? '';
    await page.getByTestId('train-as').selectOption(code);
    await train(page);
    await expect(page.getByTestId('study-line')).toContainText(code);
    await page.getByTestId('stop').click();
    await page.getByTestId('questionnaire-notice').getByRole('link').click();
    await expect(page.getByTestId('questionnaire')).toContainText(code);
  },
);

test('a study with a design: the trainee is tested, and a rater who does not know whose replay it is rates it', async ({
  browser,
}) => {
  const operator = await windowOf(browser, olga);
  await expect
    .poll(async () => (await operator.request.get(`${here.server.url}/readyz`)).status(), { timeout: 60_000 })
    .toBe(200);
  await operator.getByTestId('to-studies').click();
  await operator.getByTestId('study-name').fill('Does training help?');
  await operator.getByTestId('study-design').selectOption('arms');
  await operator.getByTestId('remove-arm-2').click();
  await operator.getByTestId('arm-sessions-1').fill('2');
  await operator.getByTestId('make-study').click();
  await expect(operator.getByTestId('study-title')).toHaveText('Does training help?');
  const joinCode = (await operator.getByTestId('study-join-code').textContent()) ?? '';
  await operator.getByTestId('rater-user').selectOption({ label: 'Ines Instructor' });
  await operator.getByTestId('add-rater').click();
  await expect(operator.getByTestId('rater-R1')).toContainText('0 of 0');

  const trainee = await windowOf(browser, tom);
  const code = await join(trainee, joinCode);
  await expect(trainee.getByTestId('next-session')).toHaveText('Your next session: test before training, 1 of 1.');
  await train(trainee);
  await reamByKeysUntil(trainee, 1);
  await trainee.getByTestId('stop').click();
  await expect(trainee.getByTestId('session-state')).toHaveAttribute('data-state', 'stopped');
  await trainee.getByTestId('to-studies').click();
  await trainee.getByRole('link', { name: 'Does training help?' }).click();
  await expect(trainee.getByTestId('next-session')).toHaveText('Your next session: training, 1 of 2.');

  // Lists and pages of sessions say nothing to the rater.
  const rater = await windowOf(browser, ines);
  await rater.getByTestId('to-sessions').click();
  await expect(rater.getByTestId('no-sessions')).toBeVisible();
  expect(await rater.locator('body').innerText()).not.toMatch(new RegExp(`Tom|${code}`));
  await rater.getByTestId('to-studies').click();
  await rater.getByRole('link', { name: 'Does training help?' }).click();
  await rater.getByTestId('to-rating').click();
  await expect(rater.getByTestId('rating-progress')).toHaveText('0 of 1 replays rated.');
  await expect(rater.getByTestId('rated-replay').locator('[data-complete="true"]')).toBeVisible({ timeout: 60_000 });
  await rater.getByTestId('play').click();
  await expect(rater.getByTestId('play')).toHaveAttribute('data-playing', 'true');
  await rater.getByTestId('send-answers').click();
  await expect(rater.getByTestId('missing')).toContainText('answers are missing');
  for (const group of await rater
    .getByRole('group')
    .filter({ has: rater.getByRole('radio') })
    .all())
    await group.getByRole('radio').nth(1).check();
  await rater.getByTestId('send-answers').click();
  await expect(rater.getByTestId('answers-status')).toContainText('saved');
  await expect(rater.getByTestId('rating-progress')).toHaveText('1 of 1 replays rated.');
  expect(await rater.locator('body').innerText()).not.toMatch(new RegExp(`Tom|${code}`));

  await operator.reload();
  await expect(operator.getByTestId('rater-R1')).toContainText('1 of 1');
  const ratings = await savedBy(operator, 'export-ratings');
  expect(ratings).toContain(`${code},novice,1,training_1,pre,R1,2,`);
  expect(ratings).not.toMatch(/Ines|Tom/);
});
