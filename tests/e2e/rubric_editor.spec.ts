// A rubric made and used: copied, tried on a recorded session, saved, and the session's review scored by it.
import { expect, type Page, test } from '@playwright/test';

import { assignSession, olga, tom } from './every_page';
import { startDemo, untilFinished } from './rest_as_page';
import { logIn, serverForEachTest } from './server_for_each_test';
import type { TestUser } from './server_process';

const ines: TestUser = { name: 'ines', role: 'instructor', displayName: 'Ines Instructor' };
const here = serverForEachTest([olga, ines, tom]);

async function copyOfStandard(page: Page, name: string): Promise<void> {
  await page.getByTestId('to-rubrics').click();
  await expect(page.getByTestId('rubric-standard')).toContainText('Standard');
  await page.getByTestId('rubric-name').fill(name);
  await page.getByTestId('create-rubric').click();
  await expect(page.getByTestId('rubric-version')).toHaveText('Version 1');
  await expect(page).toHaveTitle(`Rubric: ${name} – ream`);
}

test('a rubric is copied, tried on a session, saved, and the session is scored by it', async ({ page }) => {
  test.setTimeout(240_000);
  await page.goto(`${here.server.url}/#/sessions`);
  await logIn(page, ines.name);
  const session = await startDemo(page, here.server.url);
  await untilFinished(page, session);
  await copyOfStandard(page, 'House rubric');

  await page.getByTestId('preview-session').selectOption(session);
  const mark = page.getByTestId('preview-score').getByTestId('mark-0');
  await expect(mark).toContainText('House rubric');
  const before = await mark.locator('strong').textContent();
  await page.getByTestId('time_over_56_s-weight').fill('40');
  await expect(page.getByTestId('unsaved')).toBeVisible();
  await expect(mark.locator('strong')).not.toHaveText(before ?? '');
  const preview = await mark.locator('strong').textContent();
  await expect(page.getByTestId('score-session')).toBeDisabled();

  // Another metric, without limits of its own: it says what it needs, where it is needed.
  await page.getByTestId('add-metric').selectOption('duration_s');
  await expect(page.getByTestId('duration_s-weight')).toBeFocused();
  await expect(page.getByTestId('duration_s-at-0-fault')).toBeVisible();
  await expect(page.getByTestId('save-rubric')).toBeDisabled();
  await page.getByTestId('duration_s-at-0').fill('60');
  await page.getByTestId('duration_s-at-1').fill('30');
  await expect(page.getByTestId('duration_s-at-1-fault')).toHaveText('Each value must be above the one before.');
  await page.getByTestId('duration_s-at-1').fill('600');
  await expect(page.getByTestId('rubric-faults')).toBeHidden();
  await page.getByTestId('remove-duration_s').click();
  await expect(mark.locator('strong')).toHaveText(preview ?? '');

  // What is not saved is not lost by a click beside it.
  page.once('dialog', (dialog) => void dialog.dismiss());
  await page.getByTestId('to-all-rubrics').click();
  await expect(page.getByTestId('time_over_56_s-weight')).toHaveValue('40');
  await page.getByTestId('save-rubric').click();
  await expect(page.getByTestId('rubric-saved')).toHaveText('Saved as version 2.');
  await page.getByTestId('score-session').click();
  await expect(page.getByTestId('scored')).toBeVisible();
  await page.getByTestId('preview-review').click();
  await expect(page.getByTestId('score').getByTestId('mark-0')).toContainText('House rubric');
  await expect(page.getByTestId('score').locator('strong').first()).toHaveText(preview ?? '');
});

test('two who edit one rubric do not overwrite each other', async ({ page, context }) => {
  await page.goto(`${here.server.url}/#/sessions`);
  await logIn(page, ines.name);
  await copyOfStandard(page, 'Ours');
  const other = await context.newPage();
  await other.goto(page.url());
  await other.getByTestId('rubric-pass').fill('60');
  await page.getByTestId('rubric-pass').fill('80');
  await page.getByTestId('save-rubric').click();
  await expect(page.getByTestId('rubric-saved')).toBeVisible();
  await other.getByTestId('save-rubric').click();
  await expect(other.getByTestId('rubric-problem')).toContainText('newer version');
  await expect(other.getByTestId('rubric-pass')).toHaveValue('60');
});

test('a benchmark is made of sessions of experts', { tag: '@full' }, async ({ page }) => {
  test.setTimeout(240_000);
  await page.goto(`${here.server.url}/#/sessions`);
  await logIn(page, olga.name);
  await expect(page.getByTestId('no-sessions')).toBeVisible();
  const session = await startDemo(page, here.server.url);
  await assignSession(page, session, tom);
  await untilFinished(page, session);
  await page.getByTestId('to-rubrics').click();
  await page.getByTestId('to-benchmarks').click();
  await expect(page).toHaveTitle('Benchmarks – ream');
  await expect(page.getByTestId('create-benchmark')).toBeDisabled();
  await page.getByTestId(`group-${session}`).selectOption('novice');
  await expect(page.getByTestId('benchmark-chosen')).toContainText('at least one expert');
  await page.getByTestId(`group-${session}`).selectOption('expert');
  await page.getByTestId('benchmark-name').fill('Our experts');
  await page.getByTestId('create-benchmark').click();
  await expect(page.getByTestId('benchmark')).toContainText('Version error');
  await expect(page.getByTestId('benchmarks')).toContainText('Our experts');
});

test('trainees have neither page, nor a way to it', async ({ page }) => {
  await page.goto(`${here.server.url}/#/sessions`);
  await logIn(page, tom.name);
  await expect(page.getByTestId('no-sessions')).toBeVisible();
  await expect(page.getByTestId('to-rubrics')).toBeHidden();
  for (const hash of ['#/rubrics', '#/rubrics/standard', '#/benchmarks']) {
    await page.goto(`${here.server.url}/${hash}`);
    await expect(page.getByTestId('forbidden')).toBeVisible();
  }
});
