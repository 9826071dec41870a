// docs/administrator.md, "Your first server", read aloud: from an empty machine to users who log in over TLS, and to a
// second machine that takes over by a backup. On the page by keys.
import { expect, type Page, test } from '@playwright/test';

import { createFromTable } from './course_users';
import { machinesForEachTest } from './machine';
import { blockOfPaper, linesOfPaper } from './paper_lines';
import { practise } from './ream_a_moment';
import { logIn } from './server_for_each_test';
import { passwordOf } from './server_process';
import { storyWindows } from './story_windows';

const paper = 'docs/administrator.md';
const line = linesOfPaper(paper);
const here = machinesForEachTest();
test.setTimeout(240_000);
// Nobody but this test trusts the certificate.
test.use({ actionTimeout: 60_000, ignoreHTTPSErrors: true });

const press = (page: Page, testId: string) => page.getByTestId(testId).press('Enter');

/** The points of a session, as the page of all sessions shows them. */
async function pointsOf(page: Page, session: string): Promise<string> {
  await press(page, 'to-sessions');
  const points = page.getByTestId(`points-${session}`);
  await expect(points).toHaveText(/^\d+\.\d$/, { timeout: 60_000 });
  await points.scrollIntoViewIfNeeded();
  return (await points.textContent()) ?? '';
}

for (const { width, height, tag } of storyWindows)
  test(
    `an operator sets a server up, and another machine takes over from it, at ${width} px`,
    { tag },
    async ({ page, browser }, info) => {
      const look = (name: string, of = page) => of.screenshot({ path: info.outputPath(`${name}.png`) });
      await page.setViewportSize({ width, height });

      // 1. What the machine lacks: nothing that keeps a server from starting.
      const first = here.add();
      expect(first.type(line('ream doctor'))).toContain('good\t');

      // 2. The first user, a certificate, and the server.
      expect(first.type(line('ream user add olga'), passwordOf('olga'))).toContain('olga is operator');
      expect(first.type(line('ream user add tom'), passwordOf('tom'))).toContain('tom is trainee');
      first.putDemo();
      first.type(line('openssl req'));
      const serve = line('ream serve --host 0.0.0.0');
      const url = await first.serve(serve);
      expect(url).toMatch(/^https:/);

      // 3. The others, by the table that stands in the paper.
      await page.goto(url);
      await look('3-log-in');
      await logIn(page, 'olga');
      await expect(page.getByTestId('none-live')).toContainText('No active sessions');
      await press(page, 'to-users');
      const table = blockOfPaper(paper, 'name,role,');
      const file = { name: 'course.csv', mimeType: 'text/csv', buffer: Buffer.from(table) };
      await page.getByLabel('CSV file').setInputFiles(file);
      const passwords = await createFromTable(page);
      expect([...passwords.keys()]).toEqual(['anna', 'ben']);
      await expect(page.getByTestId('user-anna')).toContainText('Anna Example');
      await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
      await press(page, 'bulk-copy');
      await expect(page.getByTestId('bulk-copy')).toHaveText('Copied');
      const copied = await page.evaluate(() => navigator.clipboard.readText());
      expect(copied).toContain(`anna,${passwords.get('anna') ?? 'none'}`);
      await look('3-users');

      // 4. A trainee practises; the session stands in Sessions.
      const anna = await here.openWindow(browser, { width, height }, url);
      const session = await practise(anna, 'anna', passwords.get('anna') ?? '');
      await anna.getByRole('button', { name: 'Stop', exact: true }).press('Enter');
      await expect(anna.getByTestId('result-card')).toBeVisible();
      const points = await pointsOf(page, session);
      const row = page.getByTestId(`row-${session}`);
      await expect(row).toContainText('Anna Example');
      await look('4-sessions');

      // 5. The head of the audit log, and a backup, beside the running server.
      const verified = first.type(line('ream audit verify'));
      expect(verified).toMatch(/^\d+ rows are whole/);
      const head = /head (\S+)/.exec(verified)?.[1] ?? 'none';
      expect(first.type(line('ream backup backup.zip'))).toContain('backup.zip: 1 session, 1 case');
      expect(first.type(line('ream audit export'))).toContain('"data.backup"');
      expect(await first.stop()).toBe(0);

      // 6. Another machine restores it and serves.
      const second = here.add();
      first.copyTo(second, 'backup.zip');
      second.type(line('ream restore backup.zip').replace('DIR', second.data));
      second.type(line('openssl req'));
      const secondUrl = await second.serve(serve);

      // 7. Old passwords are good, old logins are not. The session is there with its points.
      await page.goto(secondUrl);
      await logIn(page, 'olga');
      expect(await pointsOf(page, session)).toBe(points);
      await expect(row).toContainText('Anna Example');
      await look('7-sessions');
      await anna.goto(secondUrl);
      await logIn(anna, 'anna', passwords.get('anna'));
      await expect(anna.getByTestId('current-user')).toContainText('Anna Example');
      expect(await pointsOf(anna, session)).toBe(points);

      // 8. The audit log says who did what; it is whole, and goes on from the head that was noted.
      await press(page, 'to-users');
      for (const name of ['olga', 'tom', 'anna', 'ben']) await expect(page.getByTestId(`user-${name}`)).toBeVisible();
      await press(page, 'to-audit');
      const log = page.getByTestId('audit').locator('tbody tr');
      const rowOf = (what: string, about: string) => log.filter({ hasText: what }).filter({ hasText: about });
      await expect(rowOf('Restored a backup', 'backup.zip')).toHaveCount(1);
      for (const name of ['olga', 'tom', 'anna', 'ben'])
        await expect(rowOf('Added a user', `${name} as`)).toHaveCount(1);
      await expect(rowOf('Logged in', 'Anna Example')).toHaveCount(2);
      await expect(rowOf('session', session).first()).toBeVisible();
      await look('8-audit-log');
      expect(second.type(line('ream audit verify --head HEAD').replace('HEAD', head))).toMatch(/^\d+ rows are whole/);
    },
  );
