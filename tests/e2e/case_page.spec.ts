// From a scanner's files to the reamer in the hand, through the page: upload, bones, landmarks, plan, bone, session.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { expect, type Locator, type Page, test } from '@playwright/test';

import type { Case, Job, Triple } from '../../web/src/wire/rest_types';
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

const details = async (page: Page, id: string): Promise<Case> =>
  (await (await page.request.get(`${here.server.url}/api/v1/cases/${id}`)).json()) as Case;

async function openStep(page: Page, name: string): Promise<Locator> {
  const step = page.getByTestId(`step-${name}`);
  const head = step.locator('h2 button');
  if ((await head.getAttribute('aria-expanded')) !== 'true') await head.click();
  return step;
}

/** Where a point is on the screen while a view shows the whole CT, worked out apart from the page. */
async function spotIn(
  page: Page,
  name: 'axial' | 'sagittal',
  ct: NonNullable<Case['ct']>,
  point: Triple,
): Promise<[number, number]> {
  const { rotation, translation_mm: t } = ct.world_from_volume;
  expect(rotation).toEqual([
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ]);
  const box = await page.getByTestId(`slice-${name}`).boundingBox();
  if (box === null) throw new Error(`the ${name} view is not there`);
  const size = (i: 0 | 1 | 2) => ct.dims[i] * ct.spacing_mm[i];
  const fromMiddle = (i: 0 | 1 | 2) => point[i] - t[i] - size(i) / 2;
  // The patient's left is on the right and the back below; from the side the back is on the right and feet below.
  const [right, down, sign] = name === 'axial' ? ([0, 1, 1] as const) : ([1, 2, -1] as const);
  const pxPerMm = Math.min(box.width / size(right), box.height / size(down));
  return [
    box.x + box.width / 2 + fromMiddle(right) * pxPerMm,
    box.y + box.height / 2 + sign * fromMiddle(down) * pxPerMm,
  ];
}

/** Scrolls the axial view to a point's slice and clicks where the point is. */
async function clickInAxial(page: Page, ct: NonNullable<Case['ct']>, point: Triple): Promise<void> {
  const index = Math.floor((point[2] - ct.world_from_volume.translation_mm[2]) / ct.spacing_mm[2]);
  const place = page.getByTestId('place-axial');
  await page.getByTestId('slice-axial').focus();
  for (let now = Number(await place.getAttribute('data-index')); now !== index; now += now < index ? 1 : -1)
    await page.keyboard.press(now < index ? 'PageDown' : 'PageUp');
  await expect(place).toHaveAttribute('data-index', String(index));
  await expect(place).toHaveAttribute('data-pending', 'false');
  await page.mouse.click(...(await spotIn(page, 'axial', ct, point)));
}

/** The same case, made without the page: its CT, and the bones where they are wanted. */
async function makeCase(page: Page, withBones: boolean): Promise<string> {
  const api = `${here.server.url}/api/v1`;
  const begun = await page.request.post(`${api}/uploads`, { data: { name: 'phantom.zip', bytes: zip.length } });
  const { id: uploadId } = (await begun.json()) as { id: string };
  for (let at = 0; at < zip.length; at += 1 << 20) {
    const data = zip.subarray(at, at + (1 << 20));
    const headers = { 'content-type': 'application/octet-stream' };
    const sent = await page.request.put(`${api}/uploads/${uploadId}?offset=${at}`, { data, headers });
    expect(sent.ok()).toBe(true);
  }
  const id = await finished(page, `${api}/cases`, { upload_id: uploadId, side: 'right', name: 'Phantom' });
  if (withBones) await finished(page, `${api}/cases/${id}/segmentation`, {});
  return id;
}

/** Begins a job and waits for its end; the case it is of. */
async function finished(page: Page, url: string, data: object): Promise<string> {
  const begun = (await (await page.request.post(url, { data })).json()) as Job;
  const state = async () =>
    ((await (await page.request.get(`${here.server.url}/api/v1/jobs/${begun.id}`)).json()) as Job).state;
  await expect.poll(state, { timeout: 120_000 }).toBe('done');
  return begun.case_id ?? '';
}

async function openCase(page: Page, id: string): Promise<void> {
  await page.goto(`${here.server.url}/#/cases/${id}`);
  await expect(page.getByTestId('place-axial')).toHaveAttribute('data-pending', 'false', { timeout: 60_000 });
}

const places = (page: Page) =>
  Promise.all(
    ['axial', 'coronal', 'sagittal'].map(async (name) =>
      Number(await page.getByTestId(`place-${name}`).getAttribute('data-index')),
    ),
  );

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
  await page.getByTestId('frame-ct').click();
  const order = [
    'glenoid_centre',
    'superior_rim',
    'inferior_rim',
    'anterior_rim',
    'posterior_rim',
    'trigonum',
  ] as const;
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
  await expect(page.getByTestId('plan-outcome')).toContainText(/Seating\d+ %.*Removed from the face\d+ mm³/);
  await page.getByTestId('keep-plan').click();
  await expect(page.getByTestId('plan-draft')).toHaveAttribute('data-kept', 'true');

  await openStep(page, 'build');
  await page.getByTestId('upsample').selectOption('2');
  await page.getByTestId('run-build').click();
  await expect(page.getByTestId('built')).toBeVisible({ timeout: 120_000 });
  expect((await details(page, id)).stage).toBe('built');

  await openStep(page, 'ream');
  await page.getByTestId('case-level').selectOption('exam');
  await page.getByTestId('case-level').selectOption('guided');
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

test('an upload survives a broken link, and what cannot be read is said', async ({ page }) => {
  await page.goto(here.server.url);
  await untilLive(page);
  await page.getByTestId('to-cases').click();
  let pieces = 0;
  await page.route('**/uploads/*?offset=*', (route) => (++pieces === 2 ? route.abort() : route.continue()));
  await page.getByTestId('file').setInputFiles({ name: 'shoulder.zip', mimeType: 'application/zip', buffer: zip });
  await page.getByTestId('side-left').check();
  await page.getByTestId('make-case').click();
  await expect(page.getByTestId('slice-axial')).toBeVisible({ timeout: 60_000 });
  expect(pieces).toBe(Math.ceil(zip.length / (1 << 20)) + 1);
  await expect(page.getByTestId('case-title')).toContainText('Left shoulder');

  await page.getByTestId('to-cases').click();
  await expect(page.getByTestId('cases')).toContainText('shoulder');
  const notes = Buffer.from('these are notes, no pictures');
  // What can never be a CT is refused when it is chosen.
  await page.getByTestId('file').setInputFiles({ name: 'photo.png', mimeType: 'image/png', buffer: notes });
  await expect(page.getByTestId('file-refused')).toContainText('photo.png');
  await expect(page.getByTestId('file-refused')).toContainText('ZIP of DICOM');
  await page.getByTestId('side-right').check();
  await expect(page.getByTestId('make-case')).toBeDisabled();
  await page.getByTestId('file').setInputFiles({ name: 'notes.zip', mimeType: 'application/zip', buffer: notes });
  await page.getByTestId('side-right').check();
  await page.getByTestId('make-case').click();
  await expect(page.getByTestId('job').or(page.getByTestId('new-case-failed')).first()).toBeVisible();
  await expect(page.getByTestId('new-case-failed')).toContainText('notes.zip');
  await expect(page.getByTestId('make-case')).toBeEnabled();

  await page.getByTestId('to-live').click();
  await untilLive(page);
});

test('cross-hair and landmarks follow pointer and keys, and are kept on the server', async ({ page }) => {
  const id = await makeCase(page, true);
  await openCase(page, id);
  await openStep(page, 'landmarks');
  await expect(page.getByTestId('surface')).toHaveAttribute('data-state', 'shown', { timeout: 60_000 });

  const coronal = page.getByTestId('slice-coronal');
  await coronal.focus();
  const [axialAt = 0, coronalAt = 0, sagittalAt = 0] = await places(page);
  for (const key of ['ArrowDown', 'ArrowRight', 'ArrowRight', 'PageDown']) await page.keyboard.press(key);
  await expect.poll(() => places(page)).toEqual([axialAt - 1, coronalAt + 1, sagittalAt + 2]);
  await page.mouse.move(...(await spotOn(coronal, 0.5, 0.5)));
  await page.mouse.wheel(0, 100);
  await expect.poll(() => places(page)).toEqual([axialAt - 1, coronalAt + 2, sagittalAt + 2]);

  // A key chooses, Enter places at the cross-hair, and the next one is chosen.
  await coronal.focus();
  await page.keyboard.press('6');
  await expect(page.getByTestId('landmark-trigonum_mm')).toHaveAttribute('aria-pressed', 'true');
  await page.keyboard.press('Enter');
  await expect(page.getByTestId('landmark-trigonum_mm')).toHaveAttribute('data-placed', 'true');
  await expect(page.getByTestId('landmark-inferior_angle_mm')).toHaveAttribute('aria-pressed', 'true');

  // The surface takes a landmark too, and the cross-hair goes there.
  await page.getByTestId('landmark-glenoid_centre_mm').click();
  const surface = page.getByTestId('surface-canvas');
  const before = await places(page);
  await page.mouse.click(...(await spotOn(surface, 0.53, 0.36)));
  await expect(page.getByTestId('landmark-glenoid_centre_mm')).toHaveAttribute('data-placed', 'true');
  await expect.poll(() => places(page)).not.toEqual(before);

  await expect(page.getByTestId('save')).toHaveAttribute('data-state', 'saved');
  await expect(page.getByTestId('missing')).toContainText('Superior rim');
  const kept = (await details(page, id)).landmarks;
  expect(Object.keys(kept ?? {}).sort()).toEqual(['glenoid_centre_mm', 'trigonum_mm']);

  // What is dragged moves.
  await page.getByTestId('landmark-trigonum_mm').click();
  await page.getByTestId('frame-ct').click();
  const { ct } = await details(page, id);
  if (ct === null || kept?.trigonum_mm === undefined) throw new Error('nothing to drag');
  const [x, y] = await spotIn(page, 'sagittal', ct, kept.trigonum_mm);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 20, y + 10, { steps: 5 });
  await page.mouse.up();
  const moved = async () => {
    const now = (await details(page, id)).landmarks?.trigonum_mm ?? [0, 0, 0];
    return Math.hypot(...now.map((value, i) => value - (kept.trigonum_mm?.[i] ?? 0)));
  };
  await expect.poll(moved).toBeGreaterThan(3);

  await coronal.focus();
  await page.keyboard.press('6');
  await page.keyboard.press('Delete');
  await expect(page.getByTestId('landmark-trigonum_mm')).toHaveAttribute('data-placed', 'false');
  await expect.poll(async () => Object.keys((await details(page, id)).landmarks ?? {})).toEqual(['glenoid_centre_mm']);

  // Left at once after a change: it is saved all the same.
  await page.keyboard.press('6');
  await coronal.focus();
  await page.keyboard.press('Enter');
  await page.goto('about:blank');
  await expect.poll(async () => Object.keys((await details(page, id)).landmarks ?? {}).length).toBe(2);
});

test('landmarks that could not be saved, or that another page changed, are shown as such', async ({ page }) => {
  const id = await makeCase(page, false);
  await openCase(page, id);
  await openStep(page, 'landmarks');
  const axial = page.getByTestId('slice-axial');
  const save = page.getByTestId('save');
  await page.route('**/landmarks', (route) => route.abort());
  await axial.focus();
  await page.keyboard.press('Enter');
  await expect(save).toHaveAttribute('data-state', 'failed');
  await expect(page.getByTestId('measures')).toHaveAttribute('data-fresh', 'false');
  await page.unroute('**/landmarks');
  await page.getByTestId('save-again').click();
  await expect(save).toHaveAttribute('data-state', 'saved');
  await expect(page.getByTestId('measures')).toHaveAttribute('data-fresh', 'true');

  const theirs = { trigonum_mm: [1, 2, 3] };
  await page.request.put(`${here.server.url}/api/v1/cases/${id}/landmarks`, { data: theirs });
  await axial.focus();
  await page.keyboard.press('Enter');
  await expect(save).toHaveAttribute('data-state', 'conflict');
  expect((await details(page, id)).landmarks).toEqual(theirs);
  await page.getByTestId('take-theirs').click();
  await expect(save).toHaveAttribute('data-state', 'saved');
  await expect(page.getByTestId('landmark-trigonum_mm')).toHaveAttribute('data-placed', 'true');
  await expect(page.getByTestId('landmark-glenoid_centre_mm')).toHaveAttribute('data-placed', 'false');
});

test('a large correction is refused until a reason is given', async ({ page }) => {
  const id = await makeCase(page, true);
  await page.request.put(`${here.server.url}/api/v1/cases/${id}/landmarks`, { data: truth });
  await openCase(page, id);
  await openStep(page, 'plan');
  await page.getByTestId('wanted-version-direction').selectOption('anteversion');
  await page.getByTestId('wanted-version').fill('12');
  await page.getByTestId('propose').click();
  await expect(page.getByTestId('plan-warning').first()).toBeVisible();
  await expect(page.getByTestId('override')).toBeVisible();
  await expect(page.getByTestId('override-keep')).toBeDisabled();
  await page.getByTestId('override-reason').fill('To show what goes wrong');
  await page.getByTestId('override-keep').click();
  await expect(page.getByTestId('plan-draft')).toHaveAttribute('data-kept', 'true');
  expect((await details(page, id)).plan).toMatchObject({ override: true, override_reason: 'To show what goes wrong' });

  // By numbers, and by hand in a slice.
  const { plan, ct } = await details(page, id);
  if (ct === null || plan === null) throw new Error('no plan to change');
  const [left, back, up] = plan.entry_mm;
  await page.getByTestId('entry-2').fill(String(up + 2));
  await page.keyboard.press('Tab');
  await expect(page.getByTestId('plan-draft')).toHaveAttribute('data-kept', 'false');
  await page.getByTestId('entry-2').fill(String(up));
  await page.keyboard.press('Tab');
  await page.getByTestId('frame-ct').click();
  await drawn(page);
  const [x, y] = await spotIn(page, 'axial', ct, plan.entry_mm);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 12, y + 16, { steps: 4 });
  await page.mouse.up();
  const entry = async (i: number) => Number(await page.getByTestId(`entry-${i}`).inputValue());
  await expect.poll(() => entry(0)).toBeGreaterThan(left + 3);
  expect(await entry(1)).toBeGreaterThan(back + 4);
  expect(await entry(2)).toBeCloseTo(up, 0);
  // What was saved once is asked about again, as soon as the changed plan is known to need it.
  await expect(page.getByTestId('override')).toBeVisible();
});

async function spotOn(element: Locator, right: number, down: number): Promise<[number, number]> {
  const box = await element.boundingBox();
  if (box === null) throw new Error('not on the page');
  return [box.x + box.width * right, box.y + box.height * down];
}
