/** Words that several pages share. */
export const pageText = {
  actions: 'Actions',
};
