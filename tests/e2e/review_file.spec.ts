// A review file: one page from disk, the network off, that shows a session, computes its bone and proves it.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { gunzipSync, gzipSync } from 'node:zlib';

import { AxeBuilder } from '@axe-core/playwright';
import { expect, type Locator, type Page, test } from '@playwright/test';

import { misplaced } from './misplaced';
import { compare, pictureOfBone } from './pixels';
import { keptDemoVariable, program } from './server_process';

const folder = mkdtempSync(join(tmpdir(), 'ream-review-file-'));
const file = join(folder, 'review.html');
const maxMb = 6;

function run(...args: string[]): void {
  const { status, stderr } = spawnSync(program, args, { encoding: 'utf8' });
  expect(status, `${args.join(' ')}: ${stderr}`).toBe(0);
}

test.beforeAll(() => {
  test.setTimeout(240_000);
  const data = process.env[keptDemoVariable] ?? '';
  const out = join(folder, 'demo-run');
  run('simulate', '--data', data, '--case', 'demo', '--script', 'demo', '--backend', 'cpu', '--out', out);
  run('export', out, '--data', data, '--format', 'review', '--out', file);
});
test.afterAll(() => rmSync(folder, { recursive: true, force: true }));
test.use({ offline: true });

const pane = (page: Page) => page.getByTestId('pane-0');
const picture = (page: Page) => page.getByTestId('review-picture');
const bone = (page: Page) => pictureOfBone(page.getByTestId('bone-canvas'));
const patiently = { timeout: 90_000 };

/** What the page asks for beside itself, and what goes wrong in it. */
function watched(page: Page): { asked: string[]; wrong: string[] } {
  const seen = { asked: [] as string[], wrong: [] as string[] };
  page.on('request', (request) => {
    // Its workers come from itself.
    if (!/^(file|blob):/.test(request.url())) seen.asked.push(request.url());
  });
  page.on('pageerror', (error) => seen.wrong.push(error.message));
  page.on('console', (message) => {
    if (message.type() === 'error') seen.wrong.push(message.text());
  });
  return seen;
}

async function open(page: Page, path = file): Promise<void> {
  await page.goto(`file://${path}`);
  await expect(pane(page)).toHaveAttribute('data-position', '0', { timeout: 60_000 });
  await expect(picture(page)).toHaveAttribute('data-stale', 'false');
}

const atTick = (of: Locator) => of.getAttribute('data-position').then(Number);

test('a review file is a whole review, from disk and without a request', async ({ page }, info) => {
  test.setTimeout(300_000);
  expect(statSync(file).size / 1e6).toBeLessThan(maxMb);
  const seen = watched(page);
  await open(page);
  await expect(page).toHaveTitle(/demo-run · Review · ream/);
  await expect(page.getByTestId('verification-result')).toContainText('leave exactly the recorded bone', patiently);
  await expect(page.getByTestId('verification-result')).toContainText('28.5 s');
  await expect(page.getByTestId('score')).toContainText('of 100');
  await expect(page.getByTestId('slices')).toHaveCount(0);
  await expect(page.getByTestId('annotation')).toHaveCount(0);
  expect((await new AxeBuilder({ page }).analyze()).violations).toEqual([]);

  // After, and before again.
  await page.getByTestId('show-reamer').uncheck();
  await page.getByTestId('view-axis').click();
  const before = await bone(page);
  await page.keyboard.press('b');
  await expect.poll(() => atTick(pane(page)), patiently).toBe(28_500);
  const changed = async () => (await compare(page, await bone(page), before)).changed;
  await expect.poll(changed, patiently).toBeGreaterThan(1000);
  await page.screenshot({ path: info.outputPath('after.png') });
  await page.keyboard.press('b');
  await expect.poll(() => atTick(pane(page)), patiently).toBe(0);
  await expect.poll(changed, patiently).toBeLessThan(40);

  // Events, and playing on from one.
  await page.keyboard.press('.');
  await expect.poll(() => atTick(pane(page)), patiently).toBeGreaterThan(500);
  const there = await atTick(pane(page));
  await page.keyboard.press('k');
  await expect.poll(() => atTick(pane(page)), patiently).toBeGreaterThan(there + 500);
  await page.keyboard.press('k');

  // Maps, of the bone that the page has computed.
  await page.getByTestId('map-plan').click();
  await expect(picture(page)).toHaveAttribute('data-map', 'plan', { timeout: 60_000 });
  await expect(page.getByTestId('legend')).toContainText('not compared');
  await page.screenshot({ path: info.outputPath('map.png') });
  await page.keyboard.press('e');
  await page.getByTestId('bone-canvas').focus();
  await page.keyboard.press('Enter');
  await expect(page.getByTestId('clear-measure')).toBeVisible();
  for (const [width, height] of [
    [390, 844],
    [820, 1180],
    [1920, 1080],
  ] as const) {
    await page.setViewportSize({ width, height });
    await page.screenshot({ path: info.outputPath(`review-file-${width}.png`) });
    expect.soft(await misplaced(page, 24), `${width}x${height}`).toEqual([]);
  }
  expect(seen).toEqual({ asked: [], wrong: [] });
});

/** The page with another content of one of its elements. */
function changedFile(name: string, id: string, change: (base64: string) => string): string {
  const path = join(folder, name);
  const html = readFileSync(file, 'utf8');
  const changed = html.replace(
    new RegExp(`(id="${id}">)([^<]*)<`),
    (_, head: string, held: string) => `${head}${change(held)}<`,
  );
  expect(changed).not.toBe(html);
  writeFileSync(path, changed);
  return path;
}

test('a damaged file says so', async ({ page }) => {
  await page.goto(`file://${changedFile('cut.html', 'ream-review', (held) => held.slice(0, held.length / 2))}`);
  await expect(page.locator('#app')).toContainText('The file is damaged');
  const half = (held: string) => held.slice(0, 4 * Math.floor(held.length / 8));
  await page.goto(`file://${changedFile('cut-causes.html', 'ream-causes', half)}`);
  await expect(page.getByTestId('session-error')).toContainText('Export the session again', patiently);
  await expect(page.getByTestId('score')).toContainText('of 100');
});

/** With another hash after the part of ticks that begins at 5 s. */
function contradicted(base64: string): string {
  const [headBytes, lengthBytes, hashAt] = [12, 4, 9];
  const file = gunzipSync(Buffer.from(base64, 'base64'));
  for (let at = headBytes; at < file.length; at += lengthBytes + file.readUInt32LE(at)) {
    const part = at + lengthBytes;
    if (file[part] !== 3 || file.readUInt32LE(part + 1) !== 5000) continue;
    file.writeUInt8(file.readUInt8(part + hashAt) ^ 1, part + hashAt);
    return gzipSync(file).toString('base64');
  }
  throw new Error('there are no ticks of 5 s');
}

test('a recording that contradicts itself is shown as far as it agrees', async ({ page }) => {
  await open(page, changedFile('forged.html', 'ream-causes', contradicted));
  await expect(page.getByTestId('recording-warning')).toContainText('not the recorded one', patiently);
  await expect(page.getByTestId('verification-result')).toContainText('agrees for the first 5.0 s', patiently);
  await page.getByTestId('after').click();
  await expect.poll(() => atTick(pane(page)), patiently).toBe(5000);
  await expect(page.getByTestId('after')).toHaveAttribute('aria-pressed', 'false');
  await page.getByTestId('before').click();
  await expect.poll(() => atTick(pane(page)), patiently).toBe(0);
});
