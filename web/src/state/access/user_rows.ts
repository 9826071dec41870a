import Papa from 'papaparse';

import { bulkUsersText } from '../../text/bulk_users_text';
import { type AccountRole, accountRoles } from '../../wire/rest_types';

/** One line of a table of users, checked. */
export interface UserRow {
  /** In the text, from 1. */
  line: number;
  name: string;
  displayName: string;
  /** As it was written where it is no role. */
  role: string;
  /** Empty: one is generated. */
  password: string;
  /** What is wrong with it; null: nothing. */
  fault: string | null;
  /** There is such a user: nothing is done. */
  exists: boolean;
}

/** What a table says; `fault` is about the whole of it. */
export interface UserTableCheck {
  rows: UserRow[];
  fault: string | null;
}

type Column = 'name' | 'displayName' | 'role' | 'password';
const columnNames: Readonly<Record<string, Column>> = {
  name: 'name',
  'login name': 'name',
  login: 'name',
  role: 'role',
  password: 'password',
  'display name': 'displayName',
};
const minPassword = 10;

/** Reads what was pasted or is in a file, with commas, semicolons or tabs, and checks every line. */
export function checkUsers(text: string, taken: readonly string[]): UserTableCheck {
  const parsed = Papa.parse<string[]>(text.trimEnd(), { skipEmptyLines: false });
  const broken = new Set(parsed.errors.filter(({ type }) => type === 'Quotes').map(({ row }) => row));
  const lines = parsed.data.map((cells, i) => ({ line: i + 1, cells: cells.map((cell) => cell.trim()) }));
  const filled = lines.filter(({ cells }) => cells.some((cell) => cell !== ''));
  const [first] = filled;
  if (first === undefined) return { rows: [], fault: null };
  const columns = columnsOf(first.cells);
  const fault = text.includes('\uFFFD') ? bulkUsersText.noUnicode : faultOfHeading(first.cells, columns);
  if (fault !== null) return { rows: [], fault };
  const rows = filled.slice(1).map(({ line, cells }) => {
    const cell = (column: Column) => cells[columns.indexOf(column)] ?? '';
    const row = {
      line,
      name: cell('name').toLowerCase(),
      displayName: cell('displayName'),
      role: cell('role').toLowerCase(),
    };
    const fault = broken.has(line - 1) ? bulkUsersText.quotes : null;
    return { ...row, password: cell('password'), fault, exists: taken.includes(row.name) };
  });
  return { rows: rows.map((row, i) => ({ ...row, fault: row.fault ?? faultOf(row, rows.slice(0, i)) })), fault: null };
}

/** Null for names that are not known. */
const columnsOf = (cells: readonly string[]): (Column | null)[] =>
  cells.map((cell) => columnNames[cell.toLowerCase().replace(/[_-]/g, ' ')] ?? null);

/** Without names of columns a display name could be taken for a password. */
function faultOfHeading(cells: readonly string[], columns: readonly (Column | null)[]): string | null {
  if (!columns.includes('name') || !columns.includes('role')) return bulkUsersText.noColumn;
  const unknown = cells.find((cell, i) => cell !== '' && columns[i] === null);
  return unknown === undefined ? null : bulkUsersText.unknownColumn(unknown);
}

function faultOf({ name, displayName, role, password }: UserRow, before: readonly UserRow[]): string | null {
  const same = before.find((row) => row.name === name);
  if (name === '') return bulkUsersText.noName;
  if (/^[@=+-]/.test(name)) return bulkUsersText.badStart;
  if (!/^[a-z0-9._@-]{1,64}$/.test(name)) return bulkUsersText.badName;
  if (same !== undefined) return bulkUsersText.twice(same.line);
  if (role === '') return bulkUsersText.noRole;
  if (!isRole(role)) return bulkUsersText.badRole;
  if ([...displayName].length > 100) return bulkUsersText.longDisplayName;
  if (password !== '' && [...password].length < minPassword) return bulkUsersText.shortPassword;
  return null;
}

export const isRole = (word: string): word is AccountRole => accountRoles.some((role) => role === word);

// Without letters and digits that are taken for each other.
const letters = 'abcdefghjkmnpqrstuvwxyz23456789';
const [groups, groupSize] = [4, 4];

/** "k7qm-x2rw-9dfh-n4tz": 79 bits of chance. */
export function generatedPassword(random: (bytes: Uint8Array<ArrayBuffer>) => Uint8Array = fromSystem): string {
  const chosen: string[] = [];
  while (chosen.length < groups * groupSize)
    for (const byte of random(new Uint8Array(32))) {
      // Every letter is equally likely.
      if (byte < 256 - (256 % letters.length)) chosen.push(letters.charAt(byte % letters.length));
    }
  return Array.from({ length: groups }, (_, i) => chosen.slice(i * groupSize, (i + 1) * groupSize).join('')).join('-');
}

const fromSystem = (bytes: Uint8Array<ArrayBuffer>) => crypto.getRandomValues(bytes);
