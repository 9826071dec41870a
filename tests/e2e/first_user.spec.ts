// A server without users lets everybody in; its first user ends that.
import { expect, test } from '@playwright/test';

import { logIn, serverForEachTest } from './server_for_each_test';
import { passwordOf } from './server_process';

const here = serverForEachTest();

test('the first user is an operator, and from then on a login is needed', async ({ page }) => {
  await page.goto(`${here.server.url}/#/users`);
  await expect(page.getByTestId('add-role').getByRole('option')).toHaveText(['Operator']);
  await page.getByTestId('add-name').fill('olga');
  await page.getByTestId('add-password').fill(passwordOf('olga'));
  await page.getByTestId('add-user').click();
  await expect(page.getByTestId('login')).toBeVisible();
  await expect(page.getByTestId('login-problem')).toContainText('A login is now required');
  await logIn(page, 'olga');
  await expect(page.getByTestId('user-olga')).toContainText('Operator');
  await expect(page.getByTestId('add-role')).toHaveValue('trainee');
});
