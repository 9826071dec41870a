// A study's own questions: written and ordered by keyboard, tried as a participant, and asked by the study.
import { expect, test } from '@playwright/test';

import { olga } from './every_page';
import { post, untilReady } from './rest_as_page';
import { logIn, serverForEachTest } from './server_for_each_test';

const here = serverForEachTest([olga]);

test('a questionnaire is written, previewed, and asked by the study that is made of it', async ({ page }) => {
  test.setTimeout(120_000);
  await page.goto(`${here.server.url}/#/studies`);
  await logIn(page, olga.name);
  await untilReady(page, here.server.url);
  await page.getByTestId('study-name').fill('Own questions');
  await page.getByTestId('study-questionnaire').selectOption('own');
  await expect(page.getByTestId('make-study')).toBeDisabled();
  await page.getByTestId('questionnaire-title').fill('After the course');
  await page.getByTestId('add-likert').press('Enter');
  await expect(page.getByTestId('words-1')).toBeFocused();
  await page.keyboard.type('It felt real.');
  await page.getByTestId('add-choice').press('Enter');
  await expect(page.getByTestId('words-2')).toBeFocused();
  await page.keyboard.type('What was hardest?');
  await page.getByTestId('option-o1').fill('The axis');
  await expect(page.getByTestId('questionnaire-faults')).toContainText('1 field');
  await page.getByTestId('option-o2').fill('The depth');
  await expect(page.getByTestId('questionnaire-faults')).toBeHidden();

  // Moved by keys, a question keeps the focus, and says where it is.
  await page.getByTestId('up-2').press('Enter');
  await expect(page.getByTestId('words-1')).toHaveValue('What was hardest?');
  await expect(page.getByTestId('down-1')).toBeFocused();
  await expect(page.getByTestId('questionnaire-editor')).toContainText('Now question 1 of 2.');

  await page.getByTestId('preview-questionnaire').click();
  const preview = page.getByTestId('questionnaire-preview');
  await expect(preview.locator('fieldset.question').first()).toContainText('What was hardest?');
  await preview.getByTestId('send-answers').click();
  await expect(preview.getByTestId('missing')).toBeVisible();
  await preview.getByTestId('q2-o1').check();
  await preview.getByTestId('q1-4').check();
  await preview.getByTestId('send-answers').click();
  await expect(preview.getByTestId('answers-status')).toContainText('nothing is sent');
  await page.keyboard.press('Escape');
  await expect(preview).toBeHidden();

  await page.getByTestId('make-study').click();
  await expect(page.getByTestId('study-title')).toContainText('Own questions');
  const study = /studies\/([a-z0-9-]+)/.exec(page.url())?.[1] ?? '';
  const { code } = await post<{ code: string }>(page, `studies/${study}/participants`, { experience: 'novice' });
  await page.goto(`${here.server.url}/#/studies/${study}/answers/${code}`);
  await expect(page.getByTestId('questionnaire')).toContainText('The depth');
});

test('a questionnaire of a file is taken and changed; another file is refused', async ({ page }) => {
  await page.goto(`${here.server.url}/#/studies`);
  await logIn(page, olga.name);
  await page.getByTestId('study-questionnaire').selectOption('own');
  const file = (name: string, content: string) => ({
    name,
    mimeType: 'application/json',
    buffer: Buffer.from(content),
  });
  await page.getByTestId('questionnaire-file').setInputFiles(file('rubric.json', '{"name": "no questions"}'));
  await expect(page.getByTestId('make-problem')).toContainText('not a questionnaire');
  await page.getByTestId('questionnaire-file').setInputFiles('../examples/questionnaire.json');
  await expect(page.getByTestId('questionnaire-title')).toHaveValue('After the course');
  await expect(page.getByTestId('make-problem')).toBeHidden();
  await page.getByTestId('remove-question-2').click();
  await expect(page.getByTestId('words-2')).toHaveValue('What else?');
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByTestId('save-questionnaire').click()]);
  expect(download.suggestedFilename()).toBe('after_the_course.json');
});
