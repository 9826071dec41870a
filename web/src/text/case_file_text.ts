/** Texts about files of CTs, plans in the list of cases, and checks of landmarks; loaded with the pages of the cases. */
export const caseFileText = {
  notACt: (name: string) =>
    `“${name}” is not a CT that can be read. Choose a ZIP of DICOM files, or one NRRD, NIfTI (.nii, .nii.gz), MHA, DICOM (.dcm) or text (.txt) file.`,
  empty: (name: string) => `“${name}” is empty. Choose another file.`,

  picture: 'Slices’ brightness and parts',

  planColumn: 'Plan',
  noPlan: 'no plan',
  planSummary: (depth: string) => `${depth} mm deep`,
  planSummaryWithVersion: (depth: string, version: string) => `${depth} mm deep, aims at ${version}`,
  practise: 'Practise',
  practiseOn: (name: string) => `Practise on ${name}`,

  noShoulder: 'No shoulder was found in this CT. Is this the right series and side?',
  noShoulderHint:
    'Go back to Cases and choose another series or side. If the shoulder is in the picture, set a seed in the scapula and segment again.',

  centreOff: (mm: string) =>
    `The glenoid centre is ${mm} mm from the middle of the four rim points. Version, plan and entry depend on it.`,
  useMiddle: 'Use the middle of the rim',
};
