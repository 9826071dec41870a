/** Texts of adding many users at once; loaded with the page of users. */
export const bulkUsersText = {
  title: 'Add many users',
  hint: 'Paste a table or choose a CSV file. Columns: name, role, and if you like display name and password.',
  generatedHint: 'Users without a password get a generated one. You can copy these once.',
  example: 'name,role,display name\nanna,trainee,Anna Example\nben,instructor,Ben Example',
  table: 'Users as CSV',
  file: 'CSV file',
  lineColumn: 'Line',
  passwordColumn: 'Password',
  given: 'in the table',
  generated: 'generated',
  stateColumn: 'Check',
  ready: 'Ready',
  exists: 'Exists already, skipped',
  created: 'Created',
  failed: (reason: string) => `Not created: ${reason}`,

  noName: 'The login name is missing.',
  badName: 'A login name has letters, digits and . _ @ - only, at most 64.',
  twice: (line: number) => `The same name is in line ${line}.`,
  noRole: 'The role is missing.',
  badRole: 'The role must be operator, instructor or trainee.',
  shortPassword: 'The password needs at least 10 characters.',
  longDisplayName: 'The display name has more than 100 characters.',
  quotes: 'A quotation mark is missing or misplaced.',
  noColumn: 'The first line needs the columns name and role.',

  create: (count: number) => (count === 1 ? 'Create 1 user' : `Create ${count} users`),
  tryAgain: (count: number) => (count === 1 ? 'Try 1 user again' : `Try ${count} users again`),
  faults: (count: number) =>
    count === 1 ? '1 line must be corrected first.' : `${count} lines must be corrected first.`,
  progress: (done: number, of: number) => `${done} of ${of}`,
  done: (created: number, failed: number) =>
    failed === 0 ? `Created: ${created}.` : `Created: ${created}. Not created: ${failed}, see the table.`,
  passwords: 'Generated passwords',
  passwordsHint: 'Copy them now. They are not shown again.',
  copyAll: 'Copy all',
};
