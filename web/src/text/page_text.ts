/** Words that several pages share. */
export const pageText = {
  actions: 'Actions',
  auditLog: 'Audit log',
  deletedSessions: 'Deleted sessions',
  copy: 'Copy',
  copied: 'Copied',
  notCopied: 'Copy it by hand',
  copyJoinCode: 'Copy join code',
  report: 'Report',
  reportOf: (id: string) => `Report of session ${id}`,
  making: (percent: string) => `Report ${percent}`,
  previousPage: 'Previous page',
  nextPage: 'Next page',
  page: (number: number) => `Page ${number}`,
  points: 'Points',
  result: 'Result',
};
