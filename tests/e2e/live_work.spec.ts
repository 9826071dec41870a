// What the live page tells of the work as it goes on: traces of every tick, kinds of bone and contact, and remarks.
import { expect, type Page, test } from '@playwright/test';

import { compare, picture, pictureOfBone } from './pixels';
import { drawn, readout, serverForEachTest, untilLive } from './server_for_each_test';

const here = serverForEachTest();
test.use({ actionTimeout: 60_000 });

const bone = (page: Page) => pictureOfBone(page.getByTestId('bone-canvas'));

test('paints kinds of bone and contact, draws feed and vibration, and keeps remarks', async ({ page }, info) => {
  test.setTimeout(300_000);
  await page.goto(here.server.url);
  await untilLive(page);
  await drawn(page);
  const plain = await bone(page);
  const quiet = [await picture(page.getByTestId('feed-plot')), await picture(page.getByTestId('vibration-plot'))];

  await page.keyboard.press('k');
  await expect(page.getByTestId('bone-kinds')).toHaveAttribute('aria-pressed', 'true');
  await expect(page.getByTestId('kinds-legend')).toContainText('Cancellous');
  await drawn(page);
  await page.screenshot({ path: info.outputPath('kinds.png') });

  await page.getByTestId('run-demo').click();
  await expect
    .poll(async () => Number(await page.getByTestId('feed-plot-now').textContent()), { timeout: 90_000 })
    .toBeGreaterThan(0);
  await expect
    .poll(async () => Number(await page.getByTestId('vibration-plot-now').textContent()))
    .toBeGreaterThan(0.05);
  await page.keyboard.press('n');
  await page.keyboard.type('Leans too far back');
  await expect(page.getByTestId('keep-live-annotation')).toContainText('Save at 0:');
  await page.keyboard.press('Enter');
  await expect(page.getByTestId('annotations')).toContainText('Leans too far back');
  await expect(page.getByTestId('live-annotation')).toHaveValue('');

  for (const [i, id] of ['feed-plot', 'vibration-plot'].entries())
    expect((await compare(page, await picture(page.getByTestId(id)), quiet[i])).changed).toBeGreaterThan(100);
  await expect
    .poll(async () => Number(await page.getByTestId('removed-volume').textContent()), { timeout: 90_000 })
    .toBeGreaterThan(60);
  await page.screenshot({ path: info.outputPath('at-work.png') });
  await page.getByTestId('stop').click();
  await expect(page.getByTestId('session-state')).toHaveAttribute('data-state', 'stopped');
  await page.getByTestId('show-reamer').uncheck();
  await drawn(page);
  // Under the cortex there is cancellous bone, which is not of the same colour.
  const painted = await bone(page);
  await page.screenshot({ path: info.outputPath('reamed-kinds.png') });
  expect((await compare(page, painted, plain)).changed).toBeGreaterThan(3000);
  await page.getByTestId('bone-kinds').click();
  await drawn(page);
  expect((await compare(page, await bone(page), painted)).changed).toBeGreaterThan(1000);

  const { sessionId } = await readout(page);
  const kept = await page.request.get(`${here.server.url}/api/v1/sessions/${sessionId}/annotations`);
  const { annotations } = (await kept.json()) as { annotations: { words: string; at_s: number }[] };
  expect(annotations.map(({ words }) => words)).toEqual(['Leans too far back']);
  expect(annotations[0]?.at_s).toBeGreaterThan(0);
});
