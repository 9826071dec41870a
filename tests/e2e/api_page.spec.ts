// The page that tells programmers what a server answers, under the server's own rules about what a page may do.
import { expect, test } from '@playwright/test';

import { serverForEachTest } from './server_for_each_test';
import type { TestUser } from './server_process';

const olga: TestUser = { name: 'olga', role: 'operator', displayName: 'Olga Operator' };

const here = serverForEachTest([olga]);

test('tells every operation to whoever asks, breaks no rule and asks no other server', async ({ page }) => {
  const violations: string[] = [];
  const elsewhere: string[] = [];
  page.on('console', (message) => {
    if (message.type() === 'error' || message.text().includes('Content Security Policy'))
      violations.push(message.text());
  });
  page.on('request', (request) => {
    if (!request.url().startsWith(here.server.url) && !request.url().startsWith('data:')) elsewhere.push(request.url());
  });
  const reply = await page.goto(`${here.server.url}/api`);
  expect(reply?.headers()['content-security-policy']).not.toContain('unsafe-inline');

  await expect(page.getByRole('heading', { name: 'ream' })).toBeVisible();
  const contract = await (await page.request.get(`${here.server.url}/api/v1/openapi.yaml`)).text();
  const operations = contract.match(/^ {6}operationId: /gm) ?? [];
  await expect(page.locator('.opblock')).toHaveCount(operations.length);

  await page.screenshot({ path: test.info().outputPath('api.png') });
  const deletion = page.locator('#operations-deletion-deleteSession');
  await deletion.getByRole('button').first().click();
  await expect(deletion).toContainText('It can be restored');
  await expect(deletion.locator('.responses-table')).toContainText('409');
  await expect(deletion).toHaveCSS('border-top-style', 'solid');
  expect(violations).toEqual([]);
  expect(elsewhere).toEqual([]);
});
