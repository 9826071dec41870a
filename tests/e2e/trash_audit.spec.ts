// What was deleted comes back, and who did what can be read, by those who may.
import { readFileSync } from 'node:fs';

import { expect, test } from '@playwright/test';

import { remove, startDemo, post } from './rest_as_page';
import { logIn, serverForEachTest } from './server_for_each_test';
import type { TestUser } from './server_process';

const olga: TestUser = { name: 'olga', role: 'operator', displayName: 'Olga Operator' };
const ines: TestUser = { name: 'ines', role: 'instructor', displayName: 'Ines Instructor' };
const tom: TestUser = { name: 'tom', role: 'trainee', displayName: 'Tom Trainee' };
const here = serverForEachTest([olga, ines, tom]);

test('a deleted session is found and restored; the audit log says who did it, and can be kept', async ({ page }) => {
  await page.goto(`${here.server.url}/#/trash`);
  await logIn(page, ines.name);
  await expect(page.getByTestId('trash-empty')).toBeVisible();
  await expect(page).toHaveTitle('Deleted sessions – ream');
  const id = await startDemo(page, here.server.url);
  await post(page, `sessions/${id}/stop`);
  await remove(page, `sessions/${id}`);

  // By the way that one would look for.
  await page.getByTestId('to-sessions').click();
  await expect(page.getByTestId('no-sessions')).toBeVisible();
  await page.getByTestId('to-trash').click();
  await expect(page.getByTestId('trash-count')).toHaveText('1 session');
  await expect(page.getByTestId(`deleted-${id}`)).toContainText('demo');
  await page.getByTestId(`restore-${id}`).click();
  await expect(page.getByTestId('restored')).toContainText(id);
  await expect(page.getByTestId('trash-empty')).toBeVisible();
  await page.getByTestId('restored').getByRole('link').click();
  await expect(page.getByTestId(`row-${id}`)).toBeVisible();

  // The log is for operators.
  await page.goto(`${here.server.url}/#/audit`);
  await expect(page.getByTestId('forbidden')).toBeVisible();
  await page.goto(`${here.server.url}/#/sessions`);
  await page.getByTestId('log-out').click();
  await logIn(page, olga.name);
  await page.getByTestId('to-users').click();
  await page.getByTestId('to-audit').click();
  await expect(page).toHaveTitle('Audit log – ream');
  const table = page.getByTestId('audit').locator('tbody');
  await expect(table).toContainText('Restored a session');
  await page.getByTestId('audit-search').fill(id);
  await expect(table.locator('tr').first()).toContainText('Ines Instructor');
  await expect(page.getByTestId('audit-count')).toContainText(' of ');
  await page.getByTestId('audit-action').selectOption('session.restore');
  await expect(table.locator('tr')).toHaveCount(1);
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByTestId('audit-csv').click()]);
  const csv = readFileSync(await download.path(), 'utf8');
  expect(csv.split('\r\n')[0]).toContain('at_utc');
  expect(csv).toContain(`session.restore,${id}`);
  expect(csv.trim().split('\r\n')).toHaveLength(2);
  await page.getByTestId('audit-search').fill('nothing is called so');
  await expect(page.getByTestId('audit-empty')).toBeVisible();
});

test('trainees have neither page, nor a way to it', async ({ page }) => {
  await page.goto(`${here.server.url}/#/sessions`);
  await logIn(page, tom.name);
  await expect(page.getByTestId('no-sessions')).toBeVisible();
  await expect(page.getByTestId('to-trash')).toBeHidden();
  for (const hash of ['#/trash', '#/audit']) {
    await page.goto(`${here.server.url}/${hash}`);
    await expect(page.getByTestId('forbidden')).toBeVisible();
  }
});
