import { describe, expect, it } from 'vitest';

import { CaseListController } from '../../../src/state/case/new_case';
import { refusedFile } from '../../../src/state/case/ct_file';
import type { CaseApi } from '../../../src/wire/case_api';
import { caseFileText } from '../../../src/text/case_file_text';
import { ApiError } from '../../../src/wire/rest';

const file = (name: string, size = 10) => ({
  name,
  size,
  lastModified: 1,
  slice: () => ({ arrayBuffer: () => Promise.resolve(new ArrayBuffer(size)) }),
});
const storage = { getItem: () => null, setItem: () => undefined, removeItem: () => undefined };

function controllerWith(error: ApiError): CaseListController {
  const api = { beginUpload: () => Promise.reject(error), cases: () => Promise.resolve([]) };
  const controller = new CaseListController(api as unknown as CaseApi, storage, () => undefined);
  controller.side.value = 'left';
  return controller;
}

describe('a file for a case', () => {
  it('is refused by its ending, in words that say what can be chosen', () => {
    for (const name of ['ct.zip', 'CT.ZIP', 'a.nrrd', 'a.nii', 'a.nii.gz', 'a.mha', 'a.txt', 'a.b.dcm'])
      expect(refusedFile(file(name))).toBeNull();
    for (const name of ['photo.png', 'zip', 'ct.zip.exe', 'a.gz', 'notes.docx'])
      expect(refusedFile(file(name))).toEqual({ name, why: 'notACt' });
    expect(refusedFile(file('ct.zip', 0))?.why).toBe('empty');
    expect(caseFileText.notACt('photo.png')).toMatch(/photo.png.*is not a CT.*ZIP of DICOM/);
  });

  it('is refused when it is chosen; what was chosen before stays', () => {
    const controller = controllerWith(new ApiError('', 0));
    controller.choose(file('ct.zip'));
    controller.choose(file('photo.png'));
    expect(controller.refused.value?.name).toBe('photo.png');
    expect(controller.file.value?.name).toBe('ct.zip');
    controller.choose(file('other.zip'));
    expect([controller.refused.value, controller.file.value?.name]).toEqual([null, 'other.zip']);
  });

  it('is resumed only where another try can help', async () => {
    for (const [status, resumable] of [
      [422, false],
      [413, false],
      [503, true],
    ] as const) {
      const controller = controllerWith(new ApiError('why', status));
      controller.choose(file('ct.zip'));
      await controller.make();
      expect(controller.state.value).toMatchObject({ kind: 'failed', during: 'upload', resumable });
    }
  });
});
