// Sessions that have ended, looked at: timeline, before and after, maps, measuring, score, files, links, two beside each other.
import { type APIResponse, expect, type Locator, type Page, test } from '@playwright/test';

import { compare, picture, pictureOfBone } from './pixels';
import { drawn, logIn, serverForEachTest } from './server_for_each_test';
import type { TestUser } from './server_process';

const olga: TestUser = { name: 'olga', role: 'operator', displayName: 'Olga Operator' };
const here = serverForEachTest([olga]);
const pane = (page: Page, place = 0) => page.getByTestId(`pane-${place}`);
const shown = (of: Locator) => of.getByTestId('review-picture');

/** What the page itself would ask, as who is logged in on it. */
async function call(page: Page, method: 'GET' | 'POST' | 'PATCH' | 'DELETE', path: string, data?: object) {
  const base = `${here.server.url}/api/v1/`;
  const who = (await (await page.request.get(`${base}login`)).json()) as { csrf_token: string | null };
  const headers = { 'x-csrf-token': who.csrf_token ?? '' };
  const answer: APIResponse = await page.request.fetch(base + path, { method, headers, data });
  expect(answer.ok(), `${method} ${path}: ${await answer.text()}`).toBe(true);
  return (await answer.text()) === '' ? {} : ((await answer.json()) as Record<string, unknown>);
}

/** Logs in, and lets the demo's hand ream for these numbers of ticks, one after the other; the sessions' ids. */
async function recorded(page: Page, ...ticks: number[]): Promise<string[]> {
  await page.goto(`${here.server.url}/#/sessions`);
  await logIn(page, olga.name);
  await expect(page.getByTestId('no-sessions')).toBeVisible();
  await expect
    .poll(async () => (await page.request.get(`${here.server.url}/readyz`)).ok(), { timeout: 90_000 })
    .toBe(true);
  const ids: string[] = [];
  for (const [i, until] of ticks.entries()) {
    const wanted = { case: 'demo', script: 'demo', device: 'script', theatre: i === 1 };
    const id = String((await call(page, 'POST', 'sessions', wanted)).id);
    await call(page, 'POST', `sessions/${id}/start`);
    await expect
      .poll(async () => Number((await call(page, 'GET', `sessions/${id}`)).tick), { timeout: 240_000 })
      .toBeGreaterThan(until);
    await call(page, 'POST', `sessions/${id}/stop`);
    ids.push(id);
  }
  return ids;
}

async function review(page: Page, ...ids: string[]): Promise<void> {
  await page.goto(`${here.server.url}/#/review/${ids.join('/')}`);
  for (const place of ids.keys()) {
    await expect(pane(page, place)).toHaveAttribute('data-position', '0', { timeout: 60_000 });
    await expect(shown(pane(page, place))).toHaveAttribute('data-stale', 'false');
  }
}

/** Pictures are drawn and compared slowly on a busy machine. */
const patiently = { timeout: 90_000 };

const bone = (of: Locator) => pictureOfBone(of.getByTestId('bone-canvas'));
/** Pixels of the bone that another look changes. */
async function changed(page: Page, of: Locator, before: string): Promise<number> {
  await drawn(page);
  return (await compare(page, await bone(of), before)).changed;
}

test('a session is gone through, mapped, measured, judged and taken home', async ({ page }, info) => {
  test.setTimeout(540_000);
  const [id = ''] = await recorded(page, 15_000);
  // From the list.
  await page.getByTestId(`review-${id}`).click();
  await expect(pane(page)).toHaveAttribute('data-position', '0', { timeout: 60_000 });
  await expect(page).toHaveURL(new RegExp(`#/review/${id}$`));
  await page.getByTestId('show-reamer').uncheck();
  await page.getByTestId('view-axis').click();
  await expect(page.getByTestId('before')).toHaveAttribute('aria-pressed', 'true');
  await drawn(page);
  const before = await bone(pane(page));

  // Timeline: events of the forces, by click and by key; after.
  await expect(page.getByTestId('thrust-chart')).toBeVisible();
  expect(await page.getByTestId('mark').count()).toBeGreaterThan(1);
  await page.keyboard.press('.');
  await expect.poll(async () => Number(await pane(page).getAttribute('data-position'))).toBeGreaterThan(500);
  await page.getByTestId('events').click();
  await page.getByTestId('event').first().click();
  await page.getByTestId('annotation').fill('Here it begins');
  await page.getByTestId('add-annotation').click();
  await expect(page.getByTestId('event').filter({ hasText: 'Here it begins' })).toBeVisible();
  await page.getByTestId('events').click();
  await page.keyboard.press('b');
  await page.keyboard.press('b');
  const after = page.getByTestId('after');
  await expect(after).toHaveAttribute('aria-pressed', 'true');
  await expect.poll(() => changed(page, pane(page), before), patiently).toBeGreaterThan(40);
  await expect(page.getByTestId('mark').and(page.getByTitle('Here it begins'))).toHaveCount(1);
  await page.screenshot({ path: info.outputPath('after.png') });

  // Maps, with their legend; at the end only.
  const bare = await bone(pane(page));
  await page.getByTestId('map-plan').click();
  await expect(shown(pane(page))).toHaveAttribute('data-map', 'plan', { timeout: 60_000 });
  await expect.poll(() => changed(page, pane(page), bare), patiently).toBeGreaterThan(5000);
  const legend = page.getByTestId('legend');
  await expect(legend).toContainText('0.25 to 0.5 mm too deep');
  await expect(legend).toContainText('not compared');
  await expect(page.getByTestId('breach-0')).toContainText(/none|pegs|not available/);
  await page.screenshot({ path: info.outputPath('map-plan.png') });
  const report = await bone(pane(page));
  await page.getByTestId('map-scale').selectOption('coarse');
  await expect(legend).toContainText('within 0.5 mm');
  await expect.poll(() => changed(page, pane(page), report), patiently).toBeGreaterThan(500);
  await page.getByTestId('before').click();
  await expect(page.getByTestId('map-at-end')).toBeVisible();
  await expect(shown(pane(page))).toHaveAttribute('data-map', 'none');
  await page.getByTestId('map-at-end').getByRole('button').click();
  await page.getByTestId('map-implant').click();
  await expect(shown(pane(page))).toHaveAttribute('data-map', 'implant', { timeout: 60_000 });

  // Measuring: two clicks; and by keys at the middle of the picture, along the axis: from the bottom of the pilot hole.
  await page.keyboard.press('e');
  const canvas = page.getByTestId('bone-canvas');
  const box = (await canvas.boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  const measures = page.getByTestId('measures');
  await page.mouse.click(box.x + 5, box.y + 5);
  await expect(measures).toContainText('no bone at this point');
  await page.mouse.click(middle.x - 30, middle.y);
  await page.mouse.click(middle.x + 30, middle.y);
  await expect(measures).toContainText('Distance');
  const value = async (name: string) => {
    const row = measures.locator('dl > div').filter({ has: page.locator('dt', { hasText: new RegExp(`^${name}$`) }) });
    return Number((await row.locator('dd').textContent())?.replace('−', '-').replace(' mm', ''));
  };
  const across = await value('Distance across the axis');
  expect(across).toBeGreaterThan(2);
  expect(across).toBeLessThan(30);
  // Seen along the axis, two places are apart by what lies across it and what lies along it.
  expect(await value('Distance')).toBeCloseTo(Math.hypot(across, await value('Depth difference')), 1);
  await expect(measures).toContainText('Implant fit at point 1');
  await page.screenshot({ path: info.outputPath('measured.png') });
  await canvas.focus();
  await page.keyboard.press('Enter');
  await expect(measures).not.toContainText('Distance');
  await expect(measures).toContainText('Depth of point 1');
  expect(await value('Depth of point 1')).toBeGreaterThan(1);
  await page.getByTestId('clear-measure').click();
  await page.keyboard.press('e');
  await expect(page.getByTestId('measure-panel')).toHaveCount(0);

  // Score: what stands behind a metric, on hover and on focus.
  const card = page.getByTestId('metric-card');
  await expect(page.getByTestId('mark-0')).toContainText('of 100');
  await page.getByTestId('metric-version_error_deg').hover();
  for (const label of ['Definition', 'Unit', 'Limits', 'Source', 'Confidence']) await expect(card).toContainText(label);
  await page.mouse.move(5, 5);
  await expect(card).toHaveCount(0);
  const name = page.getByTestId('metric-seating_percent').getByRole('button');
  await name.focus();
  await expect(card).toContainText('implant');
  await expect(name).toHaveAttribute('aria-describedby', 'metric-card');
  await page.screenshot({ path: info.outputPath('score.png') });
  await page.keyboard.press('Escape');
  await expect(card).toHaveCount(0);
  await page.getByTestId('missing-metrics').click();
  await expect(page.getByTestId('score').locator('.missing-list dd').first()).not.toBeEmpty();

  // Files.
  for (const [format, ending] of [
    ['html', 'html'],
    ['stl', 'stl'],
    ['review', 'review.html'],
  ] as const) {
    const download = page.waitForEvent('download', { timeout: 90_000 });
    await page.getByTestId(`export-${format}`).click();
    expect((await download).suggestedFilename()).toContain(ending);
  }

  // The bone once more, from what was recorded.
  await page.getByTestId('verify').click();
  await expect(page.getByTestId('verification-result')).toContainText('leave exactly the recorded bone', {
    timeout: 90_000,
  });
  await page.getByTestId('verification').scrollIntoViewIfNeeded();
  await page.screenshot({ path: info.outputPath('verified.png') });

  // Sections and slices of the live page.
  await page.getByTestId('map-none').click();
  await page.keyboard.press('t');
  await expect(page.getByTestId('live-slice-axial')).toBeVisible();
  await page.keyboard.press('1');
  await drawn(page);
  await page.screenshot({ path: info.outputPath('sections.png') });
});

test(
  'two sessions are seen side by side with one camera, each at its own moment',
  { tag: '@full' },
  async ({ page }, info) => {
    test.setTimeout(540_000);
    const [long = '', short = ''] = await recorded(page, 12_000, 5000);
    await review(page, long);
    await page.getByTestId('show-reamer').uncheck();
    await page.getByTestId('compare-with').selectOption(short);
    await expect(page).toHaveURL(new RegExp(`#/review/${long}/${short}$`));
    await expect(pane(page, 1)).toHaveAttribute('data-position', '0', { timeout: 60_000 });
    await expect(page.getByTestId('theatre-chip')).toHaveCount(1);
    const [first, second] = [pane(page, 0), pane(page, 1)];
    const differ = async () => (await compare(page, await bone(first), await bone(second))).changed;
    await drawn(page);
    await expect.poll(differ, patiently).toBeLessThan(60);

    // Turned on one, turned on both.
    const turnedFrom = await bone(first);
    await second.getByTestId('bone-canvas').focus();
    for (let i = 0; i < 4; ++i) await page.keyboard.press('ArrowLeft');
    await expect.poll(() => changed(page, first, turnedFrom), patiently).toBeGreaterThan(2000);
    await expect.poll(differ, patiently).toBeLessThan(60);

    // Each at its own moment; keys are for the one in use.
    await page.keyboard.press('b');
    await expect(second.getByTestId('after')).toHaveAttribute('aria-pressed', 'true');
    await expect(first).toHaveAttribute('data-position', '0');
    await page.getByTestId('view-axis').click();
    await drawn(page);
    const bare = [await bone(first), await bone(second)];
    await first.getByTestId('map-plan').click();
    await second.getByTestId('map-plan').click();
    for (const of of [first, second]) await expect(shown(of)).toHaveAttribute('data-map', 'plan', { timeout: 90_000 });
    for (const [i, of] of [first, second].entries())
      await expect.poll(() => changed(page, of, bare[i] ?? ''), patiently).toBeGreaterThan(5000);
    await expect(page.getByTestId('mark-1')).toContainText('Theatre');
    await page.screenshot({ path: info.outputPath('side-by-side.png') });

    await first.getByTestId('speed').selectOption('4');
    await first.getByTestId('play').click();
    await expect.poll(async () => Number(await first.getAttribute('data-position'))).toBeGreaterThan(1000);
    await page.getByTestId('close-0').click();
    await expect(page).toHaveURL(new RegExp(`#/review/${short}$`));
    // What was chosen of the one that stays is kept.
    await expect(pane(page)).toHaveAttribute('data-session', short);
    await expect(shown(pane(page))).toHaveAttribute('data-map', 'plan');
  },
);

test(
  'says what is wrong and what to do: links that end, a server that is gone, a session that was deleted',
  { tag: '@full' },
  async ({ page, browser }, info) => {
    test.setTimeout(540_000);
    const [id = ''] = await recorded(page, 5000);
    await review(page, id);

    // A link to this review, for somebody without an account.
    await page.getByTestId('share-review').click();
    await page.getByTestId('make-link').click();
    const address = await page.getByTestId('link-address').inputValue();
    expect(address).toContain(`/review/${id}`);
    const context = await browser.newContext();
    const guest = await context.newPage();
    here.watchForErrors(guest);
    await guest.goto(address);
    await expect(pane(guest)).toHaveAttribute('data-position', '0', { timeout: 60_000 });
    expect(guest.url()).not.toContain('watch=');
    await expect(guest.getByTestId('mark-0')).toContainText('Rubric');
    await expect(guest.getByTestId('files')).toContainText('Log in');
    await expect(guest.getByTestId('no-trace')).toContainText(/viewer link/i);
    await guest.getByTestId('map-plan').click();
    await expect(guest.getByTestId('map-problem')).toContainText('Log in');
    await guest.screenshot({ path: info.outputPath('guest.png') });
    const { links } = (await call(page, 'GET', 'links')) as { links: { id: string }[] };
    for (const link of links) await call(page, 'DELETE', `links/${link.id}`);
    await expect(guest.getByTestId('login-problem')).toContainText('viewer link has ended', { timeout: 60_000 });
    await context.close();

    // The network is cut: nothing counts as up to date, and it comes back by itself at the same moment.
    await page.getByTestId('seek').fill('3');
    await expect(pane(page)).toHaveAttribute('data-position', '3000');
    await here.server.kill();
    await expect(page.getByTestId('link-notice')).toContainText('lost', { timeout: 30_000 });
    await expect(shown(pane(page))).toHaveAttribute('data-stale', 'true');
    await page.screenshot({ path: info.outputPath('cut.png') });
    await here.server.start();
    await expect(shown(pane(page))).toHaveAttribute('data-stale', 'false', { timeout: 90_000 });
    await expect(pane(page)).toHaveAttribute('data-position', '3000', { timeout: 30_000 });

    // Deleted under the eyes of who looks at it, and restored.
    await call(page, 'DELETE', `sessions/${id}`);
    const sessionError = page.getByTestId('session-error');
    await expect(sessionError).toContainText('deleted', { timeout: 30_000 });
    await page.screenshot({ path: info.outputPath('deleted.png') });
    await call(page, 'POST', `sessions/${id}/restore`);
    await sessionError.getByRole('button').click();
    await expect(shown(pane(page))).toHaveAttribute('data-stale', 'false', { timeout: 60_000 });
    await page.goto(`${here.server.url}/#/review/nosuch12`);
    await expect(sessionError).toHaveAttribute('data-kind', 'gone');
    expect(await picture(sessionError)).not.toBe('');
    await expect(page.getByTestId('export-pdf')).toBeDisabled();
    await expect(page.getByTestId('score-file')).toHaveAttribute('aria-disabled', 'true');
    await expect(page.getByTestId('score-file')).not.toHaveAttribute('href', /./);
  },
);
