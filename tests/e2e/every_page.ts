// Every page that an operator can open, with something on it.
import { expect, type Page } from '@playwright/test';

import { reamByKeysUntil } from './ream_a_moment';
import { patch, post, startDemo, untilFinished, untilReady } from './rest_as_page';
import { logIn, untilLive } from './server_for_each_test';
import { settled } from './settled';
import type { TestUser } from './server_process';

export const olga: TestUser = { name: 'olga', role: 'operator', displayName: 'Olga Operator' };
export const tom: TestUser = { name: 'tom', role: 'trainee', displayName: 'Tom Trainee' };

/** Whose session it is; only staff's are nobody's. */
export async function assignSession(page: Page, session: string, { name, displayName }: TestUser): Promise<void> {
  const { users } = (await (await page.request.get(new URL('/api/v1/users', page.url()).href)).json()) as {
    users: { id: string; name: string }[];
  };
  const trainee = users.find((user) => user.name === name)?.id;
  await patch(page, `sessions/${session}`, { trainee_id: trainee, trainee: displayName });
}

/** Opens them one after the other; `lookAt` is called with each when it is complete. */
export async function goThroughEveryPage(
  page: Page,
  url: string,
  lookAt: (name: string) => Promise<void>,
): Promise<void> {
  const look = async (name: string) => {
    await settled(page);
    await lookAt(name);
  };
  await page.goto(`${url}/#/`);
  await expect(page.getByTestId('login')).toBeVisible();
  await look('login');
  await logIn(page, olga.name);
  await expect(page.getByTestId('dashboard')).toBeVisible();
  await untilReady(page, url);
  const study = await post<{ id: string; join_code: string }>(page, 'studies', {
    name: 'Who presses?',
    cases: ['demo'],
  });
  const { code } = await post<{ code: string }>(page, `studies/${study.id}/participants`, { experience: 'novice' });
  const ended = await startDemo(page, url);
  await assignSession(page, ended, tom);
  const tile = page.getByTestId(`tile-${ended}`);
  await expect(tile).toContainText(/[1-9] N/, { timeout: 60_000 });
  // What rests stays as it is for as long as it is looked at.
  await post(page, `sessions/${ended}/pause`);
  await expect(tile.getByRole('img')).toBeVisible({ timeout: 120_000 });
  await look('dashboard');

  const open = async (hash: string) => {
    await page.goto(`${url}/${hash}`);
  };
  await open('#');
  await untilLive(page);
  // The demo is nobody's, whoever it is assigned to.
  await expect(page.getByTestId('session-labels')).toContainText('Demo');
  await expect(page.getByTestId('pause-session')).toBeVisible();
  await look('live');
  await page.getByTestId('sections').click();
  await page.getByTestId('slices').click();
  await expect(page.getByTestId('live-slices')).toBeVisible();
  await look('live-tools');
  await page.getByTestId('sections').click();
  await page.getByTestId('slices').click();
  await page.getByTestId('to-trainee').click();
  await expect(page.getByTestId('trainee-page')).toBeVisible();
  await look('trainee');
  await page.getByTestId('leave-trainee').click();
  await untilLive(page);
  await post(page, `sessions/${ended}/stop`);
  await expect(page.getByTestId('results')).toBeVisible();
  await page.getByTestId('practise').click();
  await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
  await look('practice');
  // What is reamed by hand counts for a course of learning; demos do not.
  await assignSession(page, await page.evaluate(() => window.__ream.sessionId ?? ''), tom);
  await reamByKeysUntil(page, 1);
  await page.getByTestId('stop').click();
  await expect(page.getByTestId('practice-bar')).toBeHidden();

  await open('#/');
  await expect(page.getByTestId(`points-${ended}`)).toHaveText(/^\d+\.\d$/, { timeout: 60_000 });
  await expect(page.getByTestId('standing')).toBeVisible();
  await page.getByText('Show as table').click();
  await look('dashboard-learning');
  await page.getByTestId(`recent-replay-${ended}`).click();
  await page.waitForFunction((of) => window.__ream.replayOf === of && window.__ream.positionTicks !== null, ended);
  await look('replay');
  await page.getByTestId('leave-replay').click();
  // Where a session was stopped differs from run to run, and so does all that its score says. The whole demo is the same.
  const whole = await startDemo(page, url);
  await open('#');
  await untilLive(page);
  await untilFinished(page, whole);
  await expect(page.getByTestId('results')).toBeVisible();
  await look('live-ended');
  await open(`#/review/${whole}`);
  await expect(page.getByTestId('score')).toBeVisible({ timeout: 60_000 });
  await look('review');
  for (const [name, hash, testId] of [
    ['sessions', '#/sessions', `row-${ended}`],
    ['trash', '#/trash', 'trash'],
    ['cases', '#/cases', 'cases'],
    ['case', '#/cases/demo', 'surface'],
    ['studies', '#/studies', 'make-study'],
    ['study', `#/studies/${study.id}`, 'study-title'],
    ['questionnaire', `#/studies/${study.id}/answers/${code}`, 'questionnaire'],
    ['rubrics', '#/rubrics', 'rubric-standard'],
    ['rubric', '#/rubrics/standard', 'criterion-depth_error_mm'],
    ['benchmarks', '#/benchmarks', 'create-benchmark'],
    ['users', '#/users', 'user-tom'],
    ['account', '#/account', 'change-password'],
  ] as const) {
    await open(hash);
    await expect(page.getByTestId(testId).first()).toBeVisible({ timeout: 60_000 });
    await look(name);
  }
  // Which reads stand in the log, and in what order, differs from run to run; who was given sessions does not.
  await open('#/audit');
  await page.getByTestId('audit-action').selectOption('session.change');
  await expect(page.getByTestId('audit').locator('tbody tr')).toHaveCount(2);
  await look('audit');
}
