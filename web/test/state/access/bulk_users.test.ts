import { describe, expect, it } from 'vitest';

import { BulkUsers } from '../../../src/state/access/bulk_users';
import { checkUsers, generatedPassword } from '../../../src/state/access/user_rows';
import { bulkUsersText as words } from '../../../src/text/bulk_users_text';
import { ApiError } from '../../../src/wire/rest';
import type { NewUser } from '../../../src/wire/rest_types';

describe('a table of users', () => {
  it('is read by its names of columns, in any order, with any sign between', () => {
    const { rows } = checkUsers('Role;Display name;Login name\ntrainee;"Doe; Anna";Anna\n', []);
    expect(rows).toEqual([
      { line: 2, name: 'anna', displayName: 'Doe; Anna', role: 'trainee', password: '', fault: null, exists: false },
    ]);
    const tabs = 'name\trole\tpassword\nanna\ttrainee\tlong enough 1\n';
    expect(checkUsers(tabs, []).rows[0]).toMatchObject({ password: 'long enough 1' });
    expect(checkUsers(words.example, []).rows.map(({ fault }) => fault)).toEqual([null, null]);
    expect(checkUsers('  \n', [])).toEqual({ rows: [], fault: null });
  });

  it('needs names and roles, and no column that is not known', () => {
    expect(checkUsers('anna,trainee,Anna Example', [])).toEqual({ rows: [], fault: words.noColumn });
    expect(checkUsers('name,role,team\nanna,trainee,A', []).fault).toBe(words.unknownColumn('team'));
    expect(checkUsers('name,role\nz\uFFFDe,trainee', []).fault).toBe(words.noUnicode);
    expect(checkUsers('name,role\n=anna,trainee', []).rows[0]?.fault).toBe(words.badStart);
    expect(checkUsers('name,password\nanna,long enough 1', []).fault).toBe(words.noColumn);
  });

  it('says what is wrong by line', () => {
    const table = [
      'name,role,password',
      'anna,trainee',
      '',
      'ANNA,trainee',
      ',trainee',
      'b b,trainee',
      'ben,',
      'carl,boss',
      'dora,operator,short',
      'tom,trainee',
    ].join('\n');
    const { rows } = checkUsers(table, ['tom']);
    expect(rows.map(({ line, fault }) => [line, fault])).toEqual([
      [2, null],
      [4, words.twice(2)],
      [5, words.noName],
      [6, words.badName],
      [7, words.noRole],
      [8, words.badRole],
      [9, words.shortPassword],
      [10, null],
    ]);
    expect(rows.at(-1)?.exists).toBe(true);
    expect(checkUsers('name,role\nanna,"trainee', []).rows[0]?.fault).toBe(words.quotes);
  });
});

describe('many users', () => {
  const three = 'name,role,password\nanna,trainee\nben,trainee\ncarl,instructor,long enough 1';

  it('are made one by one; what fails can be tried again, and passwords stay', async () => {
    let drawn = 0;
    const bulk = new BulkUsers(() => (++drawn > 0 ? 'secret words' : ''));
    bulk.write(three);
    const asked: NewUser[] = [];
    let refused = 'ben';
    const add = (user: NewUser) => {
      asked.push(user);
      return user.name === refused ? Promise.reject(new Error('taken')) : Promise.resolve();
    };
    await bulk.create(add);
    expect(asked.map(({ name, password }) => [name, password])).toEqual([
      ['anna', 'secret words'],
      ['ben', 'secret words'],
      ['carl', 'long enough 1'],
    ]);
    expect(bulk.outcomes.value.get(3)).toEqual({ created: false, reason: 'taken' });
    expect([bulk.created.value, bulk.failed.value, bulk.open.value.length]).toEqual([2, 1, 1]);
    expect(bulk.passwordTable.split('\r\n')).toEqual(['name,password', 'anna,secret words']);
    refused = '';
    await bulk.create(add);
    expect(asked).toHaveLength(4);
    expect(drawn).toBe(2);
    expect(bulk.open.value).toEqual([]);
    expect(bulk.unsaved.value).toBe(true);
    bulk.noteCopied();
    expect(bulk.unsaved.value).toBe(false);
    bulk.write('');
    expect(bulk.generated.value.map(({ name }) => name)).toEqual(['anna', 'ben']);
  });

  it('that are there after a failed try need a new password', async () => {
    const bulk = new BulkUsers(() => 'secret words');
    bulk.write('name,role\nanna,trainee');
    await bulk.create(() => Promise.reject(new ApiError('no answer', 0)));
    await bulk.create(() => Promise.reject(new ApiError('exists', 409)));
    expect(bulk.outcomes.value.get(2)).toEqual({ created: false, reason: words.thereAfterAll });
  });

  it('are not made while a line is wrong', async () => {
    const bulk = new BulkUsers();
    bulk.write(`${three}\ndora,boss`);
    await bulk.create(() => Promise.reject(new Error('must not be asked')));
    expect(bulk.outcomes.value.size).toBe(0);
  });
});

it('generates passwords of letters that are told apart', () => {
  const made = Array.from({ length: 50 }, () => generatedPassword());
  for (const password of made) expect(password).toMatch(/^[a-hjkmnp-z2-9]{4}(-[a-hjkmnp-z2-9]{4}){3}$/);
  expect(new Set(made).size).toBe(50);
  // What would favour some letters is drawn again.
  let drawn = 0;
  const random = (bytes: Uint8Array) => bytes.fill(drawn++ === 0 ? 255 : 0);
  expect(generatedPassword(random)).toBe('aaaa-aaaa-aaaa-aaaa');
});
