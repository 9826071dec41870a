// docs/instructor.md, "Your first course", read aloud: from an empty data folder to the report of a session that was
// watched, commented on and reviewed, with an instructor and two trainees at windows of their own.
import { readFileSync } from 'node:fs';

import { expect, type Page, test } from '@playwright/test';

import { createFromTable } from './course_users';
import { practise } from './ream_a_moment';
import { logIn, readout, serverForEachTest, untilLive } from './server_for_each_test';
import { passwordOf } from './server_process';
import { storyWindows } from './story_windows';

const here = serverForEachTest([], { emptyFolder: true });
test.setTimeout(240_000);
test.use({ actionTimeout: 60_000 });

async function addUser(page: Page, name: string, displayName: string): Promise<void> {
  await page.getByTestId('add-name').fill(name);
  await page.getByTestId('add-display-name').fill(displayName);
  await page.getByTestId('add-password').fill(passwordOf(name));
  await page.getByRole('button', { name: 'Add', exact: true }).click();
}

for (const { width, height, tag } of storyWindows)
  test(
    `an instructor gives a first course, from an empty server to a report, at ${width} px`,
    { tag },
    async ({ page, browser }, info) => {
      const look = (name: string, of = page) => of.screenshot({ path: info.outputPath(`${name}.png`) });
      await page.setViewportSize({ width, height });

      // 1. The first user is an operator.
      await page.goto(here.server.url);
      await page.getByRole('link', { name: 'Users' }).click();
      await expect(page.getByText('Login is off')).toBeVisible();
      await look('1-first-user');
      await addUser(page, 'olga', 'Olga Operator');
      await expect(page.getByTestId('login-problem')).toContainText('A login is now required');

      // 2. An instructor, and two trainees by a table.
      await logIn(page, 'olga');
      await expect(page.getByTestId('user-olga')).toContainText('Operator');
      await page.getByTestId('add-role').selectOption('instructor');
      await addUser(page, 'ines', 'Ines Instructor');
      await expect(page.getByTestId('user-ines')).toContainText('Instructor');
      const table = 'name,role,display name,password\ntom,trainee,Tom Trainee,\nanna,trainee,Anna Example,';
      await page.getByLabel('Users as CSV').fill(table);
      const passwords = await createFromTable(page);
      for (const name of ['tom', 'anna']) await expect(page.getByTestId(`user-${name}`)).toContainText('Trainee');
      await look('2-users');
      await page.getByTestId('log-out').click();

      // 3. The instructor sees Overview.
      await page.goto(here.server.url);
      await logIn(page, 'ines');
      await expect(page.getByTestId('none-live')).toContainText('No active sessions');
      await look('3-overview');

      // 4. Both trainees practise, and appear.
      const anna = await here.windowOf(browser, { width, height });
      const annasSession = await practise(anna, 'anna', passwords.get('anna') ?? '');
      await look('4-trainee', anna);
      const tom = await here.windowOf(browser, { width, height });
      const session = await practise(tom, 'tom', passwords.get('tom') ?? '');
      const active = page.getByRole('region', { name: 'Active sessions' });
      for (const who of ['Tom Trainee', 'Anna Example']) await expect(active).toContainText(who);
      await expect(page.getByTestId(`tile-${annasSession}`)).toBeVisible();
      await expect(page.getByTestId(`tile-${session}`).getByRole('img')).toBeVisible({ timeout: 60_000 });
      await look('4-active-sessions');
      await anna.getByRole('button', { name: 'Stop', exact: true }).click();
      await expect(anna.getByTestId('result-card')).toBeVisible();

      // 5. The instructor watches one live, and comments.
      await page.getByTestId(`open-${session}`).click();
      await untilLive(page);
      expect((await readout(page)).sessionId).toBe(session);
      await expect(page.getByTestId('session-labels')).toContainText('Tom Trainee');
      await look('5-live');
      const comments = page.getByRole('region', { name: 'Comments' });
      await comments.getByRole('textbox').fill('Press a little less');
      await look('5-comment');
      await comments.getByRole('button', { name: /^Save/ }).click();
      await expect(tom.getByTestId('comment-notice')).toContainText(/Ines Instructor.*Press a little less/);
      await look('5-comment-arrives', tom);

      // 6. The trainee stops; the session stands in Overview with its points.
      await tom.getByRole('button', { name: 'Stop', exact: true }).click();
      await expect(tom.getByTestId('result-card')).toBeVisible();
      await page.getByRole('link', { name: 'Overview' }).click();
      const recent = page.getByTestId(`recent-${session}`);
      await expect(recent).toContainText('Tom Trainee');
      await expect(page.getByTestId(`points-${session}`)).toHaveText(/^\d+\.\d$/, { timeout: 60_000 });
      await recent.scrollIntoViewIfNeeded();
      await look('6-recent-sessions');
      await recent.getByRole('link', { name: 'Review' }).click();

      // 7. The review has the comment and the score; the report is a file.
      await expect(page.getByTestId('pane-0')).toHaveAttribute('data-position', '0', { timeout: 60_000 });
      await look('7-review');
      await page.getByTestId('events').click();
      await expect(page.getByTestId('event').filter({ hasText: 'Press a little less' })).toBeVisible();
      await page.getByTestId('events').click();
      await page.getByTestId('score').scrollIntoViewIfNeeded();
      await expect(page.getByTestId('mark-0')).toContainText('of 100');
      await look('7-score');
      const download = page.waitForEvent('download', { timeout: 120_000 });
      await page.getByRole('button', { name: 'Report (PDF)' }).click();
      const report = readFileSync(await (await download).path());
      expect(report.subarray(0, 4).toString()).toBe('%PDF');
      await look('7-report');
    },
  );
