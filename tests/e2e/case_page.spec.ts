// From a scanner's files to the reamer in the hand, through the page: upload, bones, landmarks, plan, bone, session.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { expect, type Locator, type Page, test } from '@playwright/test';

import type { CaseDetails, Triple } from '../../web/src/wire/case_types';
import { compare, picture } from './pixels';
import { drawn, readout, serverForEachTest, untilLive } from './server_for_each_test';
import { program } from './server_process';
import { zipOf } from './zip_file';

const here = serverForEachTest();

interface Truth {
  glenoid_centre_mm: Triple;
  superior_rim_mm: Triple;
  inferior_rim_mm: Triple;
  anterior_rim_mm: Triple;
  posterior_rim_mm: Triple;
  trigonum_mm: Triple;
  inferior_angle_mm: Triple;
  humeral_head: { centre_mm: Triple; radius_mm: number };
}

const versionDeg = -8;
const inclinationDeg = 6;
let folder = '';
let zip: Buffer;
let truth: Truth;

/** A phantom's series as a scanner would send it, and where its landmarks are. */
test.beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'ream-phantom-'));
  const options = ['--version-deg', String(versionDeg), '--inclination-deg', String(inclinationDeg)];
  execFileSync(program, ['phantom', '--out', join(folder, 'ct'), '--spacing-mm', '1', '--side', 'right', ...options]);
  const facts = JSON.parse(readFileSync(join(folder, 'ct', 'ground_truth.json'), 'utf8')) as { landmarks: Truth };
  truth = facts.landmarks;
  const names = readdirSync(join(folder, 'ct'), { recursive: true, withFileTypes: true });
  const slices = names.filter((entry) => entry.isFile() && entry.name.endsWith('.dcm'));
  expect(slices.length).toBeGreaterThan(50);
  zip = zipOf(
    slices.map((entry) => ({
      name: `series/${entry.name}`,
      bytes: readFileSync(join(entry.parentPath, entry.name)),
    })),
  );
});
test.afterAll(() => rmSync(folder, { recursive: true, force: true }));

async function upload(page: Page): Promise<string> {
  await page.goto(`${here.server.url}/#/cases`);
  await page.getByTestId('file').setInputFiles({ name: 'shoulder.zip', mimeType: 'application/zip', buffer: zip });
  await expect(page.getByTestId('make-case')).toBeDisabled();
  await page.getByTestId('side-right').check();
  await page.getByTestId('case-name').fill('Phantom, 8 degrees');
  await page.getByTestId('make-case').click();
  await expect(page.getByTestId('slice-axial')).toBeVisible({ timeout: 60_000 });
  return /#\/cases\/([a-z0-9-]+)$/.exec(page.url())?.[1] ?? '';
}

const details = async (page: Page, id: string): Promise<CaseDetails> =>
  (await (await page.request.get(`${here.server.url}/api/v1/cases/${id}`)).json()) as CaseDetails;

async function openStep(page: Page, name: string): Promise<Locator> {
  const step = page.getByTestId(`step-${name}`);
  const head = step.locator('h2 button');
  if ((await head.getAttribute('aria-expanded')) !== 'true') await head.click();
  return step;
}

/** Scrolls the axial view to a point's slice and clicks where the point is, worked out apart from the page. */
async function clickInAxial(page: Page, ct: NonNullable<CaseDetails['ct']>, point: Triple): Promise<void> {
  const { rotation, translation_mm: t } = ct.world_from_volume;
  expect(rotation.flat().map(Math.abs)).toEqual([1, 0, 0, 0, 1, 0, 0, 0, 1]);
  const mm = point.map((value, i) => (value - (t[i] ?? 0)) * (rotation[i]?.[i] ?? 1)) as Triple;
  const index = Math.floor(mm[2] / ct.spacing_mm[2]);
  const canvas = page.getByTestId('slice-axial');
  const place = page.getByTestId('place-axial');
  await canvas.focus();
  for (let now = Number(await place.getAttribute('data-index')); now !== index; now += now < index ? 1 : -1)
    await page.keyboard.press(now < index ? 'PageDown' : 'PageUp');
  await expect(place).toHaveAttribute('data-index', String(index));
  await expect(place).toHaveAttribute('data-pending', 'false');
  const box = await canvas.boundingBox();
  if (box === null) throw new Error('the axial view is not there');
  const size = [ct.dims[0] * ct.spacing_mm[0], ct.dims[1] * ct.spacing_mm[1]] as const;
  const pxPerMm = Math.min(box.width / size[0], box.height / size[1]);
  const way = [rotation[0][0], rotation[1][1]];
  const x = box.x + box.width / 2 + (mm[0] - size[0] / 2) * pxPerMm * (way[0] ?? 1);
  const y = box.y + box.height / 2 + (mm[1] - size[1] / 2) * pxPerMm * (way[1] ?? 1);
  await page.mouse.click(x, y);
}

test('a series becomes a case, is planned, and is reamed', async ({ page }) => {
  test.setTimeout(420_000);
  const id = await upload(page);
  const ct = (await details(page, id)).ct;
  if (ct === null) throw new Error('the case has no CT');

  for (const [edge, letter] of Object.entries({ left: 'R', right: 'L', top: 'A', bottom: 'P' }))
    await expect(page.getByTestId(`edge-axial-${edge}`)).toHaveText(letter);
  await expect(page.getByTestId('place-axial')).toHaveAttribute('data-pending', 'false');
  await drawn(page);
  const axial = page.getByTestId('slice-axial');
  const withPreview = await picture(axial);
  await page.getByTestId('show-preview').uncheck();
  await drawn(page);
  expect((await compare(page, await picture(axial), withPreview)).changed).toBeGreaterThan(300);

  await page.getByTestId('run-segmentation').click();
  await expect(page.getByTestId('parts')).toBeVisible({ timeout: 120_000 });
  await expect(page.getByTestId('part-1')).toContainText('Scapula');
  await expect(page.getByTestId('part-2')).toContainText('Humerus');
  await expect(page.getByTestId('surface')).toHaveAttribute('data-state', 'shown', { timeout: 60_000 });

  await openStep(page, 'landmarks');
  const order = ['glenoid_centre', 'superior_rim', 'inferior_rim', 'anterior_rim', 'posterior_rim', 'trigonum'] as const;
  for (const name of [...order, 'inferior_angle'] as const) {
    await expect(page.getByTestId(`landmark-${name}_mm`)).toHaveAttribute('aria-pressed', 'true');
    await clickInAxial(page, ct, truth[`${name}_mm`]);
    await expect(page.getByTestId(`landmark-${name}_mm`)).toHaveAttribute('data-placed', 'true');
  }
  await clickInAxial(page, ct, truth.humeral_head.centre_mm);
  await page.getByTestId('head-radius-number').fill(String(truth.humeral_head.radius_mm));
  await page.keyboard.press('Enter');
  await expect(page.getByTestId('save')).toHaveAttribute('data-state', 'saved');
  await expect(page.getByTestId('measures')).toHaveAttribute('data-fresh', 'true');
  await expect(page.getByTestId('version-3d')).toContainText('retroversion');
  const degrees = async (testId: string) => parseFloat((await page.getByTestId(testId).textContent()) ?? '');
  expect(Math.abs((await degrees('version-3d')) + versionDeg)).toBeLessThan(2.5);
  expect(Math.abs((await degrees('inclination-3d')) - inclinationDeg)).toBeLessThan(2.5);
  await page.getByTestId('walch').selectOption('A1');
  await expect(page.getByTestId('save')).toHaveAttribute('data-state', 'saved');
  const placed = (await details(page, id)).landmarks;
  expect(placed?.walch).toBe('A1');
  const apart = (placed?.trigonum_mm ?? [0, 0, 0]).map((value, i) => value - (truth.trigonum_mm[i] ?? 0));
  expect(Math.hypot(...apart)).toBeLessThan(1.5);

  await openStep(page, 'plan');
  await page.getByTestId('propose').click();
  await expect(page.getByTestId('plan-draft')).toHaveAttribute('data-kept', 'false');
  expect(await degrees('correction')).toBeLessThan(12);
  await page.getByTestId('keep-plan').click();
  await expect(page.getByTestId('plan-draft')).toHaveAttribute('data-kept', 'true');

  await openStep(page, 'build');
  await page.getByTestId('upsample').selectOption('2');
  await page.getByTestId('run-build').click();
  await expect(page.getByTestId('built')).toBeVisible({ timeout: 120_000 });
  expect((await details(page, id)).stage).toBe('built');

  await openStep(page, 'ream');
  await page.getByTestId('start-reaming').click();
  await untilLive(page);
  expect(page.url()).not.toContain('#/cases');
  await expect(page.getByTestId('case')).toContainText('Right shoulder');
  await expect(page.getByTestId('case')).toContainText('Phantom, 8 degrees');
  await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 30_000 });
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', /running|paused/);
  expect((await readout(page)).blocks).toBeGreaterThan(0);
  const { sessionId } = await readout(page);
  const session = (await (await page.request.get(`${here.server.url}/api/v1/sessions/${sessionId}`)).json()) as {
    case: string;
  };
  expect(session.case).toBe(id);
});
