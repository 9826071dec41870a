/** Stories are told in the window of a desk and in a phone's; the latter before a release only. */
export const storyWindows = [
  { width: 1280, height: 800, tag: [] },
  { width: 390, height: 844, tag: ['@full'] },
];
