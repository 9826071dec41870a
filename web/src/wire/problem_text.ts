/** Words for what goes wrong between page and simulator; here because the texts of pages know types of this folder. */
export const problemText = {
  noAnswer: 'The simulator does not respond.',
  unreadable: 'The simulator sent an unreadable answer.',
  status: (status: number) => `The simulator reported an error (${status}).`,
  noHello: 'The simulator sent no data.',
  surface: {
    noPly: 'the surface file has the wrong format',
    cutShort: 'the surface file is incomplete',
    noTriangles: 'the surface file has faces other than triangles',
    noCorner: 'the surface file refers to missing points',
    corners: (found: string) => `the surface file has unexpected columns (${found})`,
  },
  mapUnexplained: 'the map has no scale',
};
