import { expect, type Page } from '@playwright/test';

/** Makes the users of the table that stands on the page; their generated passwords, by name. */
export async function createFromTable(page: Page): Promise<Map<string, string>> {
  const create = page.getByTestId('bulk-create');
  await expect(create).toBeEnabled();
  await create.press('Enter');
  // Passwords are hashed slowly on purpose.
  await expect(page.getByTestId('bulk-copy')).toBeVisible({ timeout: 60_000 });
  const lines = (await page.getByTestId('bulk-passwords').inputValue()).trim().split(/\r?\n/);
  return new Map(lines.slice(1).map((line) => line.split(',') as [string, string]));
}
