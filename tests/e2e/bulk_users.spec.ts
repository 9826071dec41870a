// A course is enrolled at once: a table is checked, its users are made, and log in.
import { expect, test } from '@playwright/test';

import { olga } from './every_page';
import { logIn, serverForEachTest } from './server_for_each_test';
import { settled } from './settled';

const here = serverForEachTest([olga]);

test('users are made from a table; what is wrong is said by line, and passwords are given once', async ({ page }) => {
  test.setTimeout(120_000);
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.goto(`${here.server.url}/#/users`);
  await logIn(page, olga.name);
  const table = 'name,role,display name,password\nanna,trainee,Anna Example\nben,boss\nolga,operator';
  const file = { name: 'course.csv', mimeType: 'text/csv', buffer: Buffer.from(table) };
  await page.getByTestId('bulk-file').setInputFiles(file);
  await expect(page.getByTestId('bulk-line-3')).toContainText('The role must be');
  await expect(page.getByTestId('bulk-line-4')).toContainText('skipped');
  await expect(page.getByTestId('bulk-create')).toBeDisabled();

  // The page lets it pass, the server does not: a common word. The others are made all the same.
  await page.getByTestId('bulk-text').fill(`${table.replace('boss', 'instructor,,password123')}\ncarl,trainee`);
  await page.getByTestId('bulk-create').click();
  await expect(page.getByTestId('bulk-status')).toContainText('Created: 2. Not created: 1');
  await expect(page.getByTestId('bulk-line-3')).toContainText('Not created:');
  await expect(page.getByTestId('user-anna')).toContainText('Anna Example');
  await page.getByTestId('bulk-copy').click();
  await expect(page.getByTestId('bulk-copy')).toHaveText('Copied');
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  expect(copied.split(/\r?\n/).map((line) => line.split(',')[0])).toEqual(['name', 'anna', 'carl']);

  // With another password the one that is left is made, and nobody twice.
  await page
    .getByTestId('bulk-text')
    .fill('name,role,password\nanna,trainee\nben,instructor,quiet river stone\ncarl,trainee');
  await page.getByTestId('bulk-create').click();
  await expect(page.getByTestId('user-ben')).toBeVisible();
  await expect(page.getByTestId('bulk-passwords')).not.toHaveValue(/ben/);
  await settled(page);

  await page.getByTestId('log-out').click();
  const password = copied.split(/\r?\n/)[1]?.split(',')[1] ?? '';
  await page.goto(`${here.server.url}/#/sessions`);
  await logIn(page, 'anna', password);
  await expect(page.getByTestId('current-user')).toContainText('Anna Example');
});
