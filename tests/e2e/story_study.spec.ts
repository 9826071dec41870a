// docs/researcher.md, "Your first study", read aloud: a study with questions of its own, from its making to its tables,
// with an instructor and a participant at windows of their own.
import { readFileSync } from 'node:fs';

import { expect, type Page, test } from '@playwright/test';

import { reamByKeysUntil } from './ream_a_moment';
import { logIn, serverForEachTest } from './server_for_each_test';
import type { TestUser } from './server_process';
import { storyWindows } from './story_windows';

const olga: TestUser = { name: 'olga', role: 'operator', displayName: 'Olga Operator' };
const ines: TestUser = { name: 'ines', role: 'instructor', displayName: 'Ines Instructor' };
const tom: TestUser = { name: 'tom', role: 'trainee', displayName: 'Tom Trainee' };
const here = serverForEachTest([olga, ines, tom]);
test.setTimeout(180_000);
test.use({ actionTimeout: 30_000 });

const title = 'Does a course help?';

async function writeQuestions(page: Page): Promise<void> {
  await page.getByRole('combobox', { name: 'Questionnaire', exact: true }).selectOption('Your own questions');
  await page.getByTestId('questionnaire-title').fill('After the course');
  await page.getByRole('button', { name: 'Add scale' }).click();
  await page.getByTestId('words-1').fill('It felt real.');
  await page.getByRole('button', { name: 'Add choice' }).click();
  await page.getByTestId('words-2').fill('What was hardest?');
  await page.getByTestId('option-o1').fill('The axis');
  await page.getByTestId('option-o2').fill('The depth');
}

/** The lines of a table that is saved. */
async function tableOf(page: Page, button: string): Promise<string[]> {
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: button }).click();
  return readFileSync(await (await download).path(), 'utf8')
    .trim()
    .split('\r\n');
}

for (const { width, height, tag } of storyWindows)
  test(`a study is made, taken part in and exported, at ${width} px`, { tag }, async ({ page, browser }, info) => {
    const look = (name: string, of = page) => of.screenshot({ path: info.outputPath(`${name}.png`) });
    await page.setViewportSize({ width, height });

    // 1. The instructor makes the study, with questions.
    await page.goto(here.server.url);
    await logIn(page, ines.name);
    await page.getByRole('link', { name: 'Studies', exact: true }).click();
    await page.getByLabel('Name', { exact: true }).fill(title);
    await writeQuestions(page);
    await look('1-questions');
    await page.getByRole('button', { name: 'Preview' }).click();
    const preview = page.getByTestId('questionnaire-preview');
    await expect(preview).toContainText('What was hardest?');
    await look('1-preview');
    await preview.getByRole('button', { name: 'Close preview' }).click();
    await expect(page.getByTestId('study-case-demo')).toBeChecked({ timeout: 60_000 });
    await page.getByRole('button', { name: 'Create study' }).click();

    // 2. Its page shows the join code.
    await expect(page.getByTestId('study-title')).toHaveText(title);
    const joinCode = (await page.getByTestId('study-join-code').textContent()) ?? '';
    await page.getByTestId('study-join-code').scrollIntoViewIfNeeded();
    await look('2-join-code');

    // 3. A participant joins.
    const participant = await here.windowOf(browser, { width, height });
    await logIn(participant, tom.name);
    await participant.getByRole('link', { name: 'Studies' }).click();
    await participant.getByLabel('Join code').fill(joinCode);
    await participant.getByRole('combobox', { name: 'Experience' }).selectOption('Novice');
    await look('3-join', participant);
    await participant.getByRole('button', { name: 'Join', exact: true }).click();
    const own = participant.getByText('Your code in this study');
    await expect(own).toBeVisible();
    const code = /[2-9A-Z]{2}-[2-9A-Z]{3}/.exec((await own.textContent()) ?? '')?.[0] ?? 'no code';
    await look('3-joined', participant);

    // 4. They ream a session of it.
    await participant.getByRole('button', { name: 'Start', exact: true }).click();
    await reamByKeysUntil(participant, 10);
    await expect(participant.getByTestId('study-line')).toHaveText(`Study ${title} · ${code} · attempt 1`);
    await look('4-session', participant);
    await participant.getByRole('button', { name: 'Stop', exact: true }).click();
    await expect(participant.getByTestId('session-state')).toHaveAttribute('data-state', 'stopped');
    await look('4-ended', participant);

    // 5. They answer the questions.
    await participant.getByRole('link', { name: 'Open questionnaire' }).click();
    await participant.getByTestId('q1-4').check();
    await participant.getByLabel('The depth').check();
    await look('5-questions', participant);
    await participant.getByRole('button', { name: 'Send answers' }).click();
    await expect(participant.getByTestId('answers-status')).toContainText('Thank you');

    // 6. The instructor closes the study, and sees experience and answers.
    await page.getByRole('link', { name: 'Studies', exact: true }).click();
    await page.getByRole('link', { name: title }).click();
    const row = page.getByTestId(`participant-${code}`);
    await expect(row).toContainText('hidden');
    await expect(page.getByRole('button', { name: 'Answers (CSV)' })).toBeDisabled();
    await page.getByRole('button', { name: 'Close study' }).click();
    await look('6-close');
    await page.getByRole('alert').getByRole('button', { name: 'Close study' }).click();
    await expect(page.getByTestId('study-state')).toHaveText('Closed');
    await expect(row).toContainText(/Novice.*given/);
    await look('6-closed');

    // 7. Scores and answers as tables, without names.
    const scores = await tableOf(page, 'Sessions (CSV)');
    expect(scores[0]).toContain('version_error_deg');
    expect(scores).toHaveLength(2);
    expect(scores[1]).toContain(`${code},novice,0,1,1,demo`);
    const answers = await tableOf(page, 'Answers (CSV)');
    expect(answers).toHaveLength(2);
    expect(answers[0]).toMatch(/q1,q2/);
    expect(answers[1]).toMatch(new RegExp(`,${code},novice,.*,4,o2`));
    expect([...scores, ...answers].join()).not.toMatch(/tom/i);
    await page.getByRole('button', { name: 'Answers (CSV)' }).scrollIntoViewIfNeeded();
    await look('7-export');
  });
