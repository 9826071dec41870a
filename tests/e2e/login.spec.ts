// Who may use the page and for what: login and logout, back-off, viewer links, and logins that end while somebody watches.
import { expect, type Page, test } from '@playwright/test';

import { logIn, readout, serverForEachTest, untilLive } from './server_for_each_test';
import { passwordOf, type TestUser } from './server_process';

const olga: TestUser = { name: 'olga', role: 'operator', displayName: 'Olga Operator' };
const ines: TestUser = { name: 'ines', role: 'instructor', displayName: 'Ines Instructor' };
const tom: TestUser = { name: 'tom', role: 'trainee', displayName: 'Tom Trainee' };

const here = serverForEachTest([olga, ines, tom]);
const who = (page: Page) => page.getByTestId('current-user');

async function enter(page: Page, user: TestUser): Promise<void> {
  await page.goto(here.server.url);
  await logIn(page, user.name);
  await expect(who(page)).toContainText(user.displayName);
}

/** From whatever page who logged in begins with. */
async function runDemo(page: Page): Promise<void> {
  await page.getByTestId('to-live').click();
  await page.getByTestId('run-demo').click();
  await page.waitForFunction(() => (window.__ream.lastTick ?? 0) > 500, null, { timeout: 60_000 });
}

test('asks for a login, says what was wrong and how long to wait, and lets the right one in', async ({ page }) => {
  await page.goto(here.server.url);
  await expect(page.getByTestId('login')).toBeVisible();
  await expect(page.getByTestId('login-name')).toBeFocused();
  await expect(page.getByTestId('bone-canvas')).toBeHidden();
  await logIn(page, 'tom', 'a wrong password');
  await expect(page.getByTestId('login-problem')).toContainText('Name or password is wrong');
  await expect(page.getByTestId('login-password')).toHaveValue('');
  for (let i = 0; i < 6 && (await page.getByTestId('log-in').isEnabled()); ++i) {
    await logIn(page, 'tom', 'a wrong password');
    await expect(page.getByTestId('log-in')).not.toHaveText(/Logging in/);
  }
  await expect(page.getByTestId('log-in')).toHaveText(/Try again in \d+ s/);
  await expect(page.getByTestId('log-in')).toBeEnabled({ timeout: 60_000 });
  await logIn(page, 'tom');
  await expect(who(page)).toContainText('Tom Trainee');
  await expect(who(page)).toHaveAttribute('data-role', 'trainee');
  expect(await page.evaluate(() => document.cookie)).toBe('');

  await page.getByTestId('log-out').click();
  await expect(page.getByTestId('login-problem')).toHaveText('You have logged out.');
  await page.reload();
  await expect(page.getByTestId('login')).toBeVisible();
});

test('keeps the login over a reload, and offers what the role may do', async ({ page }) => {
  await enter(page, tom);
  await page.reload();
  await expect(who(page)).toContainText('Tom Trainee');
  await expect(page.getByTestId('practise')).toBeEnabled();
  for (const way of ['to-sessions', 'to-cases', 'to-studies']) await expect(page.getByTestId(way)).toBeVisible();
  await expect(page.getByTestId('to-users')).toBeHidden();
  await page.getByTestId('to-cases').click();
  await expect(page.getByTestId('cases')).toBeVisible();
  await expect(page.getByRole('heading', { name: 'New case' })).toBeHidden();
  await page.goto(`${here.server.url}/#/users`);
  await expect(page.getByTestId('forbidden')).toBeVisible();
});

test('changes the password, and the old one is of no more use', async ({ page }) => {
  await enter(page, tom);
  await page.getByTestId('to-account').click();
  const change = async (present: string, wanted: string, again = wanted) => {
    await page.getByTestId('password-present').fill(present);
    await page.getByTestId('password-wanted').fill(wanted);
    await page.getByTestId('password-again').fill(again);
    await page.getByTestId('change-password').click();
  };
  await change(passwordOf('tom'), 'a much better one', 'another one');
  await expect(page.getByTestId('password-status')).toContainText('do not match');
  await change('not the present one', 'a much better one');
  await expect(page.getByTestId('password-status')).toContainText('wrong');
  await change(passwordOf('tom'), 'a much better one');
  await expect(page.getByTestId('password-status')).toContainText('Password changed');
  await page.getByTestId('log-out').click();
  await logIn(page, 'tom');
  await expect(page.getByTestId('login-problem')).toContainText('wrong');
  await logIn(page, 'tom', 'a much better one');
  await expect(who(page)).toContainText('Tom Trainee');
});

test('a viewer link shows the session live and changes nothing, and its secret leaves the address', async ({
  page,
  browser,
}) => {
  await enter(page, ines);
  await runDemo(page);
  await page.getByTestId('share').click();
  await page.getByTestId('make-link').click();
  const address = await page.getByTestId('link-address').inputValue();
  expect(address).toMatch(/\/#watch=/);
  const watched = (await readout(page)).sessionId;
  await page.getByTestId('to-account').click(); // a page that draws slows the other one down

  const context = await browser.newContext();
  const viewer = await context.newPage();
  here.watchForErrors(viewer);
  await viewer.goto(address);
  await untilLive(viewer);
  expect(viewer.url()).not.toContain('watch=');
  expect((await readout(viewer)).sessionId).toBe(watched);
  await expect(who(viewer)).toHaveAttribute('data-role', 'viewer');
  // Angles are against the scapula for everybody, though a viewer may read no case.
  await expect(viewer.getByTestId('version-plan')).toBeAttached();
  await expect(viewer.locator('.gauge-note')).toHaveCount(0);
  for (const control of ['practise', 'run-demo', 'stop', 'pause-session', 'reset-session', 'share', 'log-out'])
    await expect(viewer.getByTestId(control)).toBeHidden();
  for (const way of ['to-sessions', 'to-cases', 'to-studies', 'to-users'])
    await expect(viewer.getByTestId(way)).toBeHidden();
  await viewer.reload();
  await untilLive(viewer);

  const link = page.getByTestId('links').locator('tbody tr').first();
  await link.getByRole('button').click();
  await link.getByRole('button', { name: 'Revoke' }).last().click();
  await expect(viewer.getByTestId('login-problem')).toContainText('The viewer link has ended');
  await expect(viewer.getByTestId('picture')).toBeHidden();
  expect((await readout(viewer)).live).toBe(false);
  for (const again of [() => viewer.goto(address), () => viewer.goto('about:blank').then(() => viewer.goto(address))]) {
    await again();
    await expect(viewer.getByTestId('login-problem')).toContainText('This viewer link does not work.');
    expect(viewer.url()).not.toContain('watch=');
  }
  await context.close();
});

test(
  'a login that is revoked while somebody reams ends what they see and hold, in words',
  { tag: '@full' },
  async ({ page }) => {
    await enter(page, tom);
    await page.getByTestId('practise').click();
    await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
    here.server.command('user', 'disable', 'tom');
    await expect(page.getByTestId('login-problem')).toContainText('Your login has ended');
    await expect(page.getByTestId('picture')).toBeHidden();
    const after = await readout(page);
    expect(after.live).toBe(false);
    expect(after.deviceLink).toBeNull();
  },
);

test('an operator adds, disables and removes users; the table says who is what', async ({ page, browser }) => {
  await enter(page, olga);
  await page.getByTestId('to-users').click();
  await page.getByTestId('add-name').fill('ada');
  await page.getByTestId('add-display-name').fill('Ada Lovelace');
  await page.getByTestId('add-password').fill('short');
  await page.getByTestId('add-user').click();
  await expect(page.getByTestId('users-problem')).toBeVisible();
  await page.getByTestId('add-password').fill(passwordOf('ada'));
  await page.getByTestId('add-user').click();
  await expect(page.getByTestId('user-ada')).toContainText('Ada Lovelace');
  await expect(page.getByTestId('users-problem')).toBeHidden();

  const context = await browser.newContext();
  const other = await context.newPage();
  await other.goto(here.server.url);
  await logIn(other, 'ada');
  await expect(who(other)).toHaveAttribute('data-role', 'trainee');
  await page.getByTestId('role-ada').selectOption('instructor');
  await expect(page.getByTestId('role-ada')).toHaveValue('instructor');
  await page.getByTestId('enable-ada').click();
  await expect(page.getByTestId('user-ada')).toContainText('Disabled');
  await expect(other.getByTestId('login-problem')).toContainText('Your login has ended');
  await page.getByTestId('remove-ada').click();
  await page.getByTestId('confirm-remove-ada').click();
  await expect(page.getByTestId('user-ada')).toBeHidden();
  await context.close();
});
