// `ream export --format parquet` against its CSV, read by a program of others.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';

import { parquetMetadata, parquetReadObjects } from 'hyparquet';
import { compressors } from 'hyparquet-compressors';
import Papa from 'papaparse';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

const given = process.env.REAM_BIN;
const program = given === undefined ? '' : resolve(given);
const why = given === undefined ? ' (skipped: REAM_BIN names no program)' : '';

/** Long enough for two row groups of 32,768 rows. */
const script = {
  device: 'hand',
  duration_s: 33,
  vibration: { source: 'off' },
  hand: {
    start_mm: [0, 0, -1],
    force_profile: [
      { t_s: 0, force_n: 30 },
      { t_s: 0.3, force_n: 60 },
      { t_s: 8, force_n: 0 },
    ],
  },
};
const flags = ['spindle_on', 'paused', 'hand_weakened', 'stalled', 'irrigating'];

type Row = Record<string, number>;

describe.skipIf(given === undefined)(`A Parquet file of a session${why}`, () => {
  let folder = '';

  const ream = (...words: string[]): string => {
    const told = spawnSync(program, words, {
      cwd: folder,
      env: { ...process.env, HOME: folder, REAM_DATA: join(folder, 'data') },
      encoding: 'utf8',
    });
    expect(told.status, told.stderr).toBe(0);
    return told.stdout;
  };
  const bytesOf = (name: string): ArrayBuffer => {
    const bytes = readFileSync(join(folder, name));
    return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  };
  const csvOf = (name: string): Row[] =>
    Papa.parse<Row>(readFileSync(join(folder, name), 'utf8'), {
      header: true,
      dynamicTyping: true,
      skipEmptyLines: true,
    }).data;
  /** Rows as the CSV has them. */
  const rowsOf = async (file: ArrayBuffer): Promise<Row[]> => {
    const rows = await parquetReadObjects({ file, compressors });
    return rows.map((row) => Object.fromEntries(Object.entries(row).map(([name, value]) => [name, Number(value)])));
  };

  beforeAll(() => {
    folder = mkdtempSync(join(tmpdir(), 'ream-parquet-'));
    writeFileSync(join(folder, 'script.json'), JSON.stringify(script));
    ream('simulate', '--case', 'demo', '--script', 'script.json', '--backend', 'cpu', '--out', 'run');
    ream('export', 'run', '--out', 'trace.parquet');
  }, 300_000);
  afterAll(() => rmSync(folder, { recursive: true, force: true }));

  it('has every value of the CSV', { timeout: 120_000 }, async () => {
    const rows = await rowsOf(bytesOf('trace.parquet'));
    const wanted = csvOf('run/trace.csv');
    expect(wanted.length).toBe(33_000);
    expect(Object.keys(rows[0] ?? {})).toEqual(Object.keys(wanted[0] ?? {}));
    const different = wanted.findIndex((row, i) =>
      Object.entries(row).some(([name, value]) => rows[i]?.[name] !== value),
    );
    expect(different, JSON.stringify([wanted[different], rows[different]])).toBe(-1);
    expect(rows.length).toBe(wanted.length);
    expect(rows.some((row) => row['engaged_points'] !== undefined && row['engaged_points'] > 0)).toBe(true);
  });

  it('has types, and row groups that fit into memory', () => {
    const about = parquetMetadata(bytesOf('trace.parquet'));
    expect(Number(about.num_rows)).toBe(33_000);
    expect(about.row_groups.map((group) => Number(group.num_rows))).toEqual([32_768, 232]);
    for (const { name, type, repetition_type } of about.schema.slice(1)) {
      expect(type, name).toBe(flags.includes(name) ? 'BOOLEAN' : name === 'engaged_points' ? 'INT64' : 'DOUBLE');
      expect(repetition_type, name).toBe('REQUIRED');
    }
    for (const { columns } of about.row_groups)
      for (const { meta_data } of columns) expect(meta_data?.codec).toBe('ZSTD');
  });

  it('says what its columns and its session are', () => {
    const about = parquetMetadata(bytesOf('trace.parquet'));
    const notes = Object.fromEntries(about.key_value_metadata?.map(({ key, value }) => [key, value]) ?? []);
    expect(notes).toMatchObject({ schema_version: '1', case: 'demo', side: 'right' });
    expect(about.created_by).toMatch(/^ream version \d+\.\d+\.\d+/);
    const book = JSON.parse(ream('codebook', 'trace', '--json')) as {
      column: string;
      unit: string | null;
      meaning: string;
    }[];
    const wanted = book.map(({ column, unit, meaning }) => ({ name: column, unit: unit ?? '', meaning }));
    expect(JSON.parse(notes['columns'] ?? '')).toEqual(wanted);
    const columns = about.row_groups[0]?.columns.map(({ meta_data }) => ({
      name: meta_data?.path_in_schema[0],
      ...Object.fromEntries(meta_data?.key_value_metadata?.map(({ key, value }) => [key, value]) ?? []),
    }));
    expect(columns).toEqual(wanted);
  });
});
