// docs/trainee.md, "Your first session", read aloud: a trainee alone, from the first page to a first session that has
// passed, with its result, review and report. By keys, which are the same on a small window and a large one.
import { expect, test } from '@playwright/test';

import { logIn, readout, serverForEachTest, untilLive } from './server_for_each_test';
import type { TestUser } from './server_process';
import { namedKeys, reamByKeys, untilStep } from './tutorial_hand';
import { storyWindows } from './story_windows';

const olga: TestUser = { name: 'olga', role: 'operator', displayName: 'Olga Operator' };
const tom: TestUser = { name: 'tom', role: 'trainee', displayName: 'Tom Trainee' };
const here = serverForEachTest([olga, tom]);
test.setTimeout(420_000);

for (const { width, height, tag } of storyWindows)
  test(`a trainee passes a first session alone, at ${width} px`, { tag }, async ({ page }, info) => {
    const look = (name: string) => page.screenshot({ path: info.outputPath(`${name}.png`) });
    await page.setViewportSize({ width, height });

    // 1. Open the page and log in. You see Live.
    await page.goto(here.server.url);
    await look('1-log-in');
    await logIn(page, tom.name);
    await expect(page.getByTestId('to-live')).toHaveAttribute('aria-current', 'page');

    // 2. Press Tutorial and follow it.
    const start = page.getByRole('button', { name: 'Tutorial', exact: true });
    await expect(page.getByTestId('tutorial-offer')).toBeVisible();
    // The server prepares its demo first.
    await expect(start).toBeEnabled({ timeout: 120_000 });
    await start.scrollIntoViewIfNeeded();
    await look('2-tutorial');
    await start.focus();
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => window.__ream.deviceLink === 'holding', null, { timeout: 60_000 });
    await untilStep(page, 'look');
    await reamByKeys(page);
    const [shift = '', tab = '', enter = ''] = await namedKeys(page);
    await page.keyboard.press(`${shift}+${tab}`);
    await page.keyboard.press(enter);
    await untilStep(page, 'finished');

    // 3. The card shows the result.
    const mark = page.getByTestId('result-mark');
    await mark.scrollIntoViewIfNeeded();
    await look('3-result');
    await expect(mark).toHaveText(/^Passed.*of 100 points$/);

    // 4. Report (PDF) and Review.
    const { sessionId } = await readout(page);
    const download = page.waitForEvent('download', { timeout: 120_000 });
    await page.getByRole('button', { name: 'Report (PDF)' }).click();
    expect((await download).suggestedFilename()).toMatch(/\.pdf$/);
    await page.getByTestId('result-review').click();
    await expect(page).toHaveURL(new RegExp(`#/review/${sessionId ?? 'none'}$`));
    await expect(page.getByTestId('score')).toContainText('Passed', { timeout: 60_000 });
    await look('4-review');

    // 5. Overview has your learning curve.
    await page.getByTestId('to-dashboard').click();
    await expect(page.getByTestId('dashboard')).toContainText('Passed', { timeout: 60_000 });
    await look('5-overview');

    // 6. Back in Live, the case and the level of the next session stand beside Practise.
    await page.getByTestId('to-live').click();
    await untilLive(page);
    await expect(page.getByTestId('tutorial-offer')).toBeHidden();
    await expect(page.getByLabel('Case', { exact: true })).toHaveValue('demo');
    await expect(page.getByLabel('Level', { exact: true })).toHaveValue('guided');
  });
